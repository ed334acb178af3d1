// SPDX-License-Identifier: Apache-2.0
// MPCDI files that are wrong, cut off, swapped or huge are refused with one line that names the
// file, and what in it.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/picture.h"
#include "tests/common/formats/sample_walls.h"

namespace aquarama::formats {
namespace {

using test::archiveOf;
using test::bytesOf;
using test::complaintOf;
using test::kManifest;

struct Mistake {
    const char* name;
    const char* part;
    const char* other;
    const char* complaint;
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, areRefusedInOneLineWithTheirPlace) {
    std::string manifest = kManifest;
    const std::size_t at = manifest.find(GetParam().part);
    ASSERT_NE(at, std::string::npos);
    manifest.replace(at, std::string(GetParam().part).size(), GetParam().other);
    const std::string complaint = complaintOf(archiveOf(manifest));
    EXPECT_THAT(complaint, testing::StartsWith("wall.mpcdi: "));
    EXPECT_THAT(complaint, testing::HasSubstr(GetParam().complaint));
    EXPECT_THAT(complaint, testing::HasSubstr("; "));
    EXPECT_THAT(complaint, testing::Not(testing::HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    Mpcdi,
    Mistakes,
    testing::Values(
        Mistake{"root", "<MPCDI", "<OTHER", "is no whole XML"},
        Mistake{"profile", "\"2d\"", "\"4d\"", "mpcdi.xml: MPCDI has the profile \"4d\""},
        Mistake{"version", "version=\"1.0\">", "version=\"3.0\">", "version \"3.0\""},
        Mistake{"noRegion", "<region ", "<regal ", "buffer \"buffer1\" has no region"},
        Mistake{"twice",
                "<region ",
                "<region id=\"a\" Xresolution=\"4\" Yresolution=\"2\"/><region ",
                "region \"a\" is there twice"},
        Mistake{"noId", "id=\"a\"", "", "a region has no id"},
        Mistake{"resolution", "\"4\"", "\"4.5\"", "region \"a\" has a resolution of 4.5 x 2"},
        Mistake{"hugeResolution", "\"4\"", "\"1e99\"", "resolution of 1e+99"},
        Mistake{"fraction", "x=\"0\"", "x=\"1.5\"", "region \"a\" has a x of 1.5, outside"},
        Mistake{"noNumber", "x=\"0\"", "x=\"0,5\"", "a x of \"0,5\", which is no number"},
        Mistake{"nan", "x=\"0\"", "x=\"nan\"", "no number"},
        Mistake{"empty", "xsize=\"1\"", "xsize=\"0\"", "takes nothing of its buffer"},
        Mistake{"stranger",
                "fileset region=\"a\"",
                "fileset region=\"b\"",
                "fileset \"b\" is for a region that is not there"},
        Mistake{"filesetTwice",
                "<files>",
                "<files><fileset region=\"a\"/>",
                "fileset \"a\" is there twice"},
        Mistake{"missingFile",
                "a.pfm",
                "b.pfm",
                "names \"b.pfm\" as its geometryWarpFile, which is not in the archive"},
        Mistake{"slip", "a.pfm", "../../a.pfm", "names \"../../a.pfm\""},
        Mistake{"swapped",
                "<alphaMap/>",
                "<alphaMap><path>a.pfm</path></alphaMap>",
                "wall.mpcdi: a.pfm: is no whole PNG"},
        Mistake{"swappedBack", "a.pfm", "mpcdi.xml", "wall.mpcdi: mpcdi.xml: is no float map"},
        Mistake{"unit",
                "<interpolation>",
                "<geometricUnit>ell</geometricUnit><interpolation>",
                "unknown geometricUnit"},
        Mistake{"frustum", "\"2d\"", "\"3d\"", "region \"a\" has no frustum"},
        Mistake{"angle",
                "ysize=\"1\"/>",
                "ysize=\"1\"><frustum><yaw>1</yaw></frustum></region>",
                "frustum without pitch"},
        Mistake{"frame",
                "ysize=\"1\"/>",
                "ysize=\"1\"><coordinateFrame/></region>",
                "coordinateFrame without posx"},
        Mistake{"control", "id=\"a\"", "id=\"a&#10;b\"", "is for a region that is not there"}),
    [](const testing::TestParamInfo<Mistake>& mistake) { return mistake.param.name; });

struct BadColour {
    const char* name;
    const char* region;
    std::string mix, red;
    const char* complaint;
};

class BadColours : public testing::TestWithParam<BadColour> {};

TEST_P(BadColours, areRefusedInOneLineWithTheirRegion) {
    const auto& [name, region, mix, red, expected] = GetParam();
    std::string manifest = kManifest;
    manifest.replace(manifest.find("</MPCDI>"),
                     8,
                     "<extensionSet><extension Name=\"Aquarama\"><colour region=\"" +
                         std::string(region) + "\"><mix>" + mix + "</mix><red>" + red +
                         "</red><green>0 1</green><blue>0 1</blue></colour></extension>"
                         "</extensionSet></MPCDI>");
    const std::string complaint = complaintOf(archiveOf(manifest));
    if (expected == nullptr) {
        EXPECT_EQ(complaint, "");
        return;
    }
    EXPECT_THAT(complaint,
                testing::StartsWith("wall.mpcdi: mpcdi.xml: colour of region \"" +
                                    std::string(region) + "\" " + expected));
    EXPECT_THAT(complaint, testing::HasSubstr("; export it anew"));
    EXPECT_THAT(complaint, testing::Not(testing::HasSubstr("\n")));
}

// So many times the same.
std::string times(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

const std::string kUnit = "1 0 0 0 1 0 0 0 1";

INSTANTIATE_TEST_SUITE_P(
    Mpcdi,
    BadColours,
    testing::Values(
        BadColour{"good", "a", "\n 1 0 0\n 0 1 0\t0 0 1 ", " 0\n.5 1 ", nullptr},
        BadColour{"longest", "a", kUnit, times(1023, "0 ") + "1", nullptr},
        BadColour{"stranger", "b", kUnit, "0 1", "is for a region that is not there"},
        BadColour{"fewMixes", "a", "1 0 0 0 1 0 0 0", "0 1", "has a mix of 8 numbers, not 9"},
        BadColour{"noMix", "a", "", "0 1", "has a mix of 0 numbers, not 9"},
        BadColour{"manyMixes", "a", kUnit + " 1", "0 1", "has a mix of 10 numbers, not 9"},
        BadColour{"largeMix", "a", "101 0 0 0 1 0 0 0 1", "0 1", "has too many or too large"},
        BadColour{"grey", "a", "1 1 1 1 1 1 1 1 1", "0 1", "has a mix that gives the same to"},
        BadColour{"noNumber", "a", "1,0 0 0 0 1 0 0 0 1", "0 1", "has a mix of \"1,0\", which"},
        BadColour{"nan", "a", kUnit, "0 nan 1", "has a red of \"nan\", which is no number"},
        BadColour{"none", "a", kUnit, "", "has a red response of 0 samples, not of 2 to 1024"},
        BadColour{"one", "a", kUnit, "1", "has a red response of 1 samples"},
        BadColour{"long", "a", kUnit, times(1024, "0 ") + "1", "has too many or too large"},
        BadColour{"foot", "a", kUnit, "0.01 1", "has a red response that does not run from 0 to 1"},
        BadColour{"top", "a", kUnit, "0 0.99", "has a red response that does not run"},
        BadColour{"falls", "a", kUnit, "0 0.5 0.4 1", "has a red response that falls"}),
    [](const testing::TestParamInfo<BadColour>& colour) { return colour.param.name; });

TEST(MpcdiDamage, aRegionHasOneColour) {
    WallFile wall = test::sampleWall(Profile::Content);
    wall.channels[0].name = "one";
    for (FileChannel& channel : wall.channels) channel.colour = test::sampleColour();
    const std::vector<std::byte> bytes = encodeMpcdi(wall, 2);
    Archive archive(bytes, "written");
    const std::vector<std::byte> text = archive.read("mpcdi.xml");
    std::string manifest(reinterpret_cast<const char*>(text.data()), text.size());
    manifest.replace(manifest.find("<colour region=\"one\""), 20, "<colour region=\"rechts\"");
    EXPECT_THAT(complaintOf(archiveOf(manifest)),
                testing::HasSubstr("colour of region \"rechts\" is there twice"));
}

TEST(MpcdiDamage, differentOriginsInOneFileAreRefused) {
    WallFile wall = test::sampleWall(Profile::Screen);
    const std::vector<std::byte> bytes = encodeMpcdi(wall, 1);
    Archive archive(bytes, "written");
    std::vector<ArchiveFile> files;
    for (const std::string& name : archive.names()) files.emplace_back(name, archive.read(name));
    std::string manifest(reinterpret_cast<const char*>(files[0].second.data()),
                         files[0].second.size());
    manifest.replace(manifest.find("floorCenter"), 11, "centerOfMass");
    files[0].second = bytesOf(manifest);
    EXPECT_THAT(complaintOf(encodeArchive(files)), testing::HasSubstr("another originOf3DData"));
}

TEST(MpcdiDamage, aPoseNeedsAPositionForSl) {
    std::string manifest = kManifest;
    manifest.replace(manifest.find("\"2d\""), 4, "\"sl\"");
    manifest.replace(manifest.find("ysize=\"1\"/>"),
                     11,
                     "ysize=\"1\"><frustum><yaw>1</yaw><pitch>1</pitch><roll>1</roll><rightAngle>1"
                     "</rightAngle><leftAngle>-1</leftAngle><upAngle>1</upAngle><downAngle>-1"
                     "</downAngle></frustum></region>");
    EXPECT_THAT(complaintOf(archiveOf(manifest)), testing::HasSubstr("has no coordinateFrame"));
}

TEST(MpcdiDamage, aManifestWithoutItsArchiveIsRefused) {
    EXPECT_THAT(complaintOf(bytesOf(kManifest)),
                testing::HasSubstr("wall.mpcdi: fileset \"a\" names \"a.pfm\", but this is"));
}

TEST(MpcdiDamage, hugeManifestsAreRefused) {
    std::string manifest = kManifest;
    manifest += std::string(std::size_t{9} << 20, ' ');
    EXPECT_THAT(complaintOf(archiveOf(manifest)), testing::HasSubstr("has 9437"));
    // Many elements that inherit one long name of a namespace.
    std::string many = kManifest;
    many.replace(many.find("<MPCDI "), 7, "<MPCDI xmlns:a=\"" + std::string(1 << 20, 'x') + "\" ");
    std::string extensions;
    for (int i = 0; i < 1000; ++i) extensions += "<e/>";
    many.replace(many.find("<files>"), 7, extensions + "<files>");
    EXPECT_THAT(complaintOf(archiveOf(many)), testing::HasSubstr("too many extensions"));
}

TEST(MpcdiDamage, deepXmlIsRead) {
    std::string manifest = kManifest, deep;
    for (int i = 0; i < 300000; ++i) deep += "<e>";
    for (int i = 0; i < 300000; ++i) deep += "</e>";
    manifest.replace(manifest.find("<files>"), 7, deep + "<files>");
    const WallFile wall = readMpcdi(archiveOf(manifest), "wall.mpcdi");
    ASSERT_EQ(wall.extensions.size(), 1U);
    EXPECT_EQ(wall.extensions[0].xml.size(), 299999U * 7 + 4);
}

// A file that is cut off has lost the directory of the archive, which is at its end.
TEST(MpcdiDamage, aFileCutAnywhereIsRefused) {
    const std::vector<std::byte> bytes = archiveOf(kManifest);
    for (std::size_t size = 4; size < bytes.size(); ++size) {
        const std::string complaint =
            complaintOf({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
        ASSERT_THAT(complaint, testing::StartsWith("wall.mpcdi: ")) << size;
    }
}

TEST(MpcdiDamage, aManifestCutAnywhereIsRefused) {
    const std::string manifest = kManifest;
    for (std::size_t size = 0; size + 2 < manifest.size(); ++size) {
        const std::string complaint = complaintOf(archiveOf(manifest.substr(0, size)));
        ASSERT_THAT(complaint, testing::StartsWith("wall.mpcdi: mpcdi.xml: ")) << size;
    }
}

TEST(MpcdiDamage, aFloatMapCutAnywhereIsRefused) {
    const std::vector<std::byte> pfm = encodePfm(test::smallPfm());
    for (std::size_t size = 0; size < pfm.size(); ++size) {
        const std::vector<std::byte> cut(pfm.begin(),
                                         pfm.begin() + static_cast<std::ptrdiff_t>(size));
        const std::string complaint =
            complaintOf(encodeArchive({{"mpcdi.xml", bytesOf(kManifest)}, {"a.pfm", cut}}));
        ASSERT_THAT(complaint, testing::StartsWith("wall.mpcdi: a.pfm: ")) << size;
    }
}

TEST(MpcdiDamage, aHugeFileIsRefusedBeforeItIsRead) {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "aquarama-huge.mpcdi";
    std::ofstream(path) << "PK";
    std::filesystem::resize_file(path, std::uintmax_t{1} << 40);  // takes no place on the disk
    EXPECT_THAT(complaintOf([&] { (void)readWallFile(path); }),
                testing::HasSubstr("aquarama-huge.mpcdi: has 1099511627776 bytes, more than"));
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace aquarama::formats
