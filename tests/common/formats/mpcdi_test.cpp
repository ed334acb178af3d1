// SPDX-License-Identifier: Apache-2.0
// MPCDI files of others, in every way they spell it, and our own: what is written is read again.
#include "common/formats/mpcdi.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/picture.h"
#include "common/base/units.h"
#include "tests/common/formats/sample_walls.h"

namespace aquarama::formats {
namespace {

using test::archiveOf;
using test::bytesOf;
using test::expectSame;
using test::kManifest;

// The text with something else in the place of a part, which must be there.
std::string with(std::string text, const std::string& part, const std::string& other) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return at == std::string::npos ? text : text.replace(at, part.size(), other);
}

WallFile readText(const std::string& manifest) {
    return readMpcdi(archiveOf(manifest), "wall.mpcdi");
}

WallFile rewritten(const WallFile& wall, int version) {
    return readMpcdi(encodeMpcdi(wall, version), "again.mpcdi");
}

// The manifest that is written for a wall.
std::string manifestOf(const WallFile& wall, int version) {
    const std::vector<std::byte> bytes = encodeMpcdi(wall, version);
    Archive archive(bytes, "written");
    const std::vector<std::byte> text = archive.read("mpcdi.xml");
    return {reinterpret_cast<const char*>(text.data()), text.size()};
}

// Real files of others, which are not part of the tree.
class RealFiles : public testing::TestWithParam<const char*> {
  protected:
    static std::filesystem::path pathOf(const std::string& name) {
        return std::filesystem::path(AQUARAMA_SOURCE_DIR) / ".." / "shared" / "data" / "mpcdi" /
               name;
    }
    void SetUp() override {
        if (!std::filesystem::exists(pathOf(GetParam())))
            GTEST_SKIP() << pathOf(GetParam()) << " is not on this machine";
    }
};

TEST_P(RealFiles, areReadAndComeBackFromBothVersions) {
    const WallFile wall = readWallFile(pathOf(GetParam()));
    ASSERT_EQ(wall.channels.size(), 1U);
    EXPECT_TRUE(wall.channels[0].warp.has_value());
    for (const int version : {1, 2}) expectSame(rewritten(wall, version), wall);
}

TEST_P(RealFiles, floatMapsKeepEveryByte) {
    const std::vector<std::byte> bytes = readWhole(pathOf(GetParam()), 1 << 20);
    Archive archive(bytes, GetParam());
    for (const std::string& name : archive.names()) {
        if (!name.ends_with(".pfm")) continue;
        const std::vector<std::byte> file = archive.read(name);
        const std::vector<std::byte> again = encodePfm(decodePfm(file, name));
        const std::size_t texels = 12 * decodePfm(file, name).texels.size();
        ASSERT_GE(again.size(), texels);
        EXPECT_TRUE(std::equal(file.end() - static_cast<std::ptrdiff_t>(texels),
                               file.end(),
                               again.end() - static_cast<std::ptrdiff_t>(texels)))
            << name;
        const bool isExact = again == file;  // the other has -1.000 in its header
        EXPECT_EQ(isExact, std::string(GetParam()).starts_with("reflib/")) << name;
    }
}

// Of the file that is written for what was read: unlit texels stay zero or no number, and numbers
// that mean nothing stay as well.
TEST_P(RealFiles, floatMapsAreWrittenWithEveryByteThatWasRead) {
    const std::vector<std::byte> bytes = readWhole(pathOf(GetParam()), 1 << 20);
    const std::vector<std::byte> written = encodeMpcdi(readMpcdi(bytes, GetParam()), 1);
    const auto mapsOf = [](const std::vector<std::byte>& file) {
        Archive archive(file, "maps");
        std::vector<std::vector<std::byte>> maps;
        for (const std::string& name : archive.names())
            if (name.ends_with(".pfm"))
                maps.push_back(encodePfm(decodePfm(archive.read(name), name)));
        return maps;
    };
    EXPECT_GE(mapsOf(bytes).size(), 1U);
    EXPECT_TRUE(mapsOf(bytes) == mapsOf(written));
}

INSTANTIATE_TEST_SUITE_P(Mpcdi,
                         RealFiles,
                         testing::Values("correction_mesh.mpcdi",
                                         "reflib/Media2D.mpcdi",
                                         "reflib/Sim3D.mpcdi",
                                         "reflib/Advanced3D.mpcdi",
                                         "reflib/ShaderLamp.mpcdi"));

class Correction : public RealFiles {};
INSTANTIATE_TEST_SUITE_P(Mpcdi, Correction, testing::Values("correction_mesh.mpcdi"));

TEST_P(Correction, hasOffsetsFromNodesAndAnglesOfOneTurn) {
    const WallFile wall = readWallFile(pathOf(GetParam()));
    EXPECT_EQ(wall.profile, Profile::View);
    const FileChannel& channel = wall.channels[0];
    EXPECT_EQ(channel.sizePixels, glm::ivec2(512, 540));
    EXPECT_EQ(channel.warp->stored, Stored::Offsets);
    EXPECT_EQ(channel.warp->sampling, Sampling::Nodes);
    EXPECT_FALSE(channel.blend.has_value());
    EXPECT_NEAR(channel.frustum->yaw, (326.675157 - 360) * kDegree, 1e-12);
    EXPECT_NEAR(channel.frustum->down, -34.644394 * kDegree, 1e-12);
    // The first texel of the file is the bottom left one.
    EXPECT_NEAR(channel.warp->samples[31 * 32].x, -0.104620F, 1e-5);
    EXPECT_NEAR(channel.warp->samples[31 * 32].y, 1 - 0.126087F, 1e-5);
    const WallFile turned = readWallFile(pathOf(GetParam()), {.upsideDown = true});
    EXPECT_NEAR(turned.channels[0].warp->samples[0].y, -0.126087F, 1e-5);
    const WallFile centres = readWallFile(pathOf(GetParam()), {.sampling = Sampling::Centres});
    EXPECT_NEAR(centres.channels[0].warp->samples[31 * 32].x, 0.5F / 32 - 0.104620F, 1e-5);
}

class EveryProfile : public testing::TestWithParam<Profile> {};

// Samples of our own are none that the format can say exactly, but for points.
TEST_P(EveryProfile, aWallComesBackFromBothVersions) {
    WallFile wall = test::sampleWall(GetParam());
    wall.channels[1].colour = test::sampleColour();
    const float tolerance = GetParam() == Profile::Screen ? 0 : std::ldexp(1.0F, -24);
    for (const int version : {1, 2}) {
        const WallFile once = rewritten(wall, version);
        expectSame(once, wall, tolerance);
        expectSame(rewritten(once, version), once);
        EXPECT_EQ(encodeMpcdi(once, version), encodeMpcdi(once, version));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Mpcdi,
    EveryProfile,
    testing::Values(Profile::Content, Profile::View, Profile::Screen, Profile::Projector));

TEST(MpcdiWriter, bothVersionsSayTheirLevel) {
    WallFile wall = test::sampleWall(Profile::Content);
    EXPECT_THAT(manifestOf(wall, 1), testing::HasSubstr("level=\"4\" version=\"1.0\""));
    EXPECT_THAT(manifestOf(wall, 2),
                testing::HasSubstr("geometry=\"2\" color=\"2\" version=\"2.0\""));
    for (FileChannel& channel : wall.channels) {
        channel.warp = test::sampleWarp({1, 1}, 3);
        channel.blend = channel.black = std::nullopt;
    }
    EXPECT_THAT(manifestOf(wall, 1), testing::HasSubstr("level=\"1\""));
}

TEST(MpcdiWriter, whereValuesWouldBeTakenOtherwiseTheFileSaysSo) {
    WallFile wall = test::sampleWall(Profile::Content);
    EXPECT_THAT(manifestOf(wall, 1), testing::Not(testing::HasSubstr("Aquarama")));
    wall.channels[1].warp->sampling = Sampling::Nodes;
    EXPECT_THAT(manifestOf(wall, 1), testing::HasSubstr("sampling=\"nodes\" values=\"places\""));
    EXPECT_EQ(rewritten(wall, 1).channels[1].warp->sampling, Sampling::Nodes);
    // Places about zero look like offsets, and values of a region that is nearly all like the
    // buffer's.
    wall = test::sampleWall(Profile::View);
    for (glm::vec3& sample : wall.channels[0].warp->samples) sample = {-0.01F, 0.99F, 0};
    wall.channels[0].warp->samples[0].x = 0.02F;
    expectSame(rewritten(wall, 2), wall, std::ldexp(1.0F, -24));
    wall = test::sampleWall(Profile::Content);
    wall.channels[0].corner = {0, 0.004};
    wall.channels[0].extent = {0.996, 0.996};
    for (glm::vec3& sample : wall.channels[0].warp->samples) sample.y *= 0.996F;
    expectSame(rewritten(wall, 1), wall, std::ldexp(1.0F, -23));
}

TEST(MpcdiWriter, aColourCanBeRead) {
    WallFile wall = test::sampleWall(Profile::Content);
    wall.channels[0].colour = {.mix = glm::mat3(0.5F, 0, 0.25F, 0, 1, 0, 0, 0, 1),
                               .response = {{{0, 0.25F, 1}, {0, 1}, {0, 0.1F, 1}}}};
    const std::string manifest = manifestOf(wall, 2);
    EXPECT_THAT(manifest, testing::HasSubstr("<extension Name=\"Aquarama\""));
    EXPECT_THAT(manifest, testing::HasSubstr("<colour region=\"left + 1.a\">"));
    EXPECT_THAT(manifest, testing::HasSubstr("<mix>0.5 0 0 0 1 0 0.25 0 1</mix>"));
    EXPECT_THAT(manifest, testing::HasSubstr("<blue>0 0.1 1</blue>"));
}

TEST(MpcdiWriter, aColourThatCannotBeReadIsNotWritten) {
    WallFile wall = test::sampleWall(Profile::Content);
    wall.channels[1].colour.emplace();
    const auto complaint = [&] { return test::complaintOf([&] { (void)encodeMpcdi(wall, 1); }); };
    EXPECT_THAT(
        complaint(),
        testing::HasSubstr("channel \"rechts\" cannot be written as MPCDI: its colour has a "
                           "red response of 0 samples, not of 2 to 1024"));
    wall.channels[1].colour = test::sampleColour();
    wall.channels[1].colour->mix[1][2] = std::nanf("");
    EXPECT_THAT(complaint(), testing::HasSubstr("its colour has a mix with a number beyond 100"));
    wall.channels[1].colour = test::sampleColour();
    wall.channels[1].colour->response[1][3] = std::nanf("");
    EXPECT_THAT(complaint(), testing::HasSubstr("its colour has a green response that falls"));
}

TEST(MpcdiWriter, whatAProfileNeedsIsAskedFor) {
    const auto complaint = [](const WallFile& wall) {
        return test::complaintOf([&] { (void)encodeMpcdi(wall, 1); });
    };
    WallFile wall = test::sampleWall(Profile::Projector);
    wall.channels[1].coordinateFrame.reset();
    EXPECT_THAT(complaint(wall),
                testing::HasSubstr(
                    "channel \"rechts\" cannot be written as MPCDI: it has no coordinateFrame"));
    wall.channels[1].frustum.reset();
    EXPECT_THAT(complaint(wall), testing::HasSubstr("no frustum"));
    wall = test::sampleWall(Profile::Content);
    wall.channels[1].name = wall.channels[0].name;
    EXPECT_THAT(complaint(wall), testing::HasSubstr("another has its name"));
    wall.channels[1].name = "";
    EXPECT_THAT(complaint(wall), testing::HasSubstr("no name"));
    wall.channels[0].sizePixels = {};
    EXPECT_THAT(complaint(wall), testing::HasSubstr("size of its picture"));
    wall.channels.clear();
    EXPECT_THAT(complaint(wall), testing::HasSubstr("without channels"));
}

TEST(MpcdiWriter, oddNamesOfChannelsMakeHarmlessEntries) {
    WallFile wall = test::sampleWall(Profile::Content);
    wall.channels[0].name = "../../a\\b:c <\"&>";
    wall.channels[1].name = "../../a/b:c <\"&>";
    const WallFile back = rewritten(wall, 1);
    EXPECT_EQ(back.channels[0].name, wall.channels[0].name);
    EXPECT_EQ(back.channels[1].name, wall.channels[1].name);
    expectSame(*back.channels[1].blend, *wall.channels[1].blend);
}

TEST(MpcdiWriter, aFileOnTheDiskIsReadAgain) {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "aquarama-mpcdi-test.mpcdi";
    const WallFile wall = test::sampleWall(Profile::Screen);
    writeMpcdi(path, wall, 2);
    expectSame(readWallFile(path), wall);
    std::filesystem::remove(path);
}

// Extensions.

constexpr const char* kExtensions =
    R"(<extensionSet><!-- kept out --><extension Name="BufferExtension" hasExternalFiles="true">
    <x:fisheye f1="1.0"><f3>3 &lt; 4</f3> tail<![CDATA[<raw>]]></x:fisheye><file>sub/Lens.dat</file>
  </extension><extension Name="Other"><generated/></extension></extensionSet></MPCDI>)";

std::vector<std::byte> extendedArchive() {
    std::string manifest = with(kManifest, "</MPCDI>", kExtensions);
    manifest = with(manifest, "<MPCDI ", "<MPCDI xmlns:x=\"urn:x\" ");
    manifest =
        with(manifest, "<alphaMap/>", "<alphaMap/><decodeLUT><path>lut.bin</path></decodeLUT>");
    manifest = with(manifest, "<region", "<note>of the buffer</note><region");
    manifest = with(manifest, "<display>", "<display><wish/>");
    return encodeArchive({{"mpcdi.xml", bytesOf(manifest)},
                          {"a.pfm", encodePfm(test::smallPfm())},
                          {"sub/lens.dat", bytesOf("lens")},
                          {"lut.bin", bytesOf("table")},
                          {"nobody mentions it", bytesOf("rest")}});
}

TEST(MpcdiExtensions, areKeptWithTheirFiles) {
    const WallFile wall = readMpcdi(extendedArchive(), "wall.mpcdi");
    ASSERT_EQ(wall.extensions.size(), 3U);
    EXPECT_EQ(wall.extensions[0].place, "display");
    EXPECT_THAT(wall.extensions[1].xml,
                testing::HasSubstr("<f3>3 &lt; 4</f3> tail<![CDATA[<raw>]]>"));
    EXPECT_THAT(wall.extensions[1].xml, testing::HasSubstr("xmlns:x=\"urn:x\""));
    using Files = std::vector<ArchiveFile>;
    EXPECT_EQ(wall.extensions[1].files,
              (Files{{"sub/lens.dat", bytesOf("lens")}, {"nobody mentions it", bytesOf("rest")}}));
    ASSERT_EQ(wall.channels[0].extensions.size(), 2U);
    EXPECT_EQ(wall.channels[0].extensions[0].place, "buffer");
    EXPECT_EQ(wall.channels[0].extensions[1].files, (Files{{"lut.bin", bytesOf("table")}}));
}

TEST(MpcdiExtensions, surviveARoundTripOfBothVersions) {
    const WallFile wall = readMpcdi(extendedArchive(), "wall.mpcdi");
    for (const int version : {1, 2}) expectSame(rewritten(wall, version), wall);
}

TEST(MpcdiExtensions, anUnreadableOneIsNotWritten) {
    WallFile wall = test::sampleWall(Profile::Content);
    wall.extensions.push_back({.xml = "<a><b></a>", .files = {}});
    EXPECT_THAT(test::complaintOf([&] { (void)encodeMpcdi(wall, 1); }),
                testing::HasSubstr("an extension of \"extensionSet\" is no XML"));
}

// Spellings.

struct Spelling {
    const char* name;
    std::vector<std::pair<const char*, const char*>> changes;
};

class Spellings : public testing::TestWithParam<Spelling> {};

TEST_P(Spellings, meanTheSame) {
    std::string manifest = kManifest;
    for (const auto& [part, other] : GetParam().changes) manifest = with(manifest, part, other);
    const WallFile expected = readText(kManifest);
    expectSame(readText(manifest), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Mpcdi,
    Spellings,
    testing::Values(
        Spelling{"resolution",
                 {{"id=\"a\" Xresolution", "id=\"a\" xResolution"},
                  {"\"4\" Yresolution", "\"4\" yresolution"}}},
        Spelling{"size", {{"xsize", "xSize"}, {"ysize", "ySize"}}},
        Spelling{"mark", {{"<?xml", "\xEF\xBB\xBF<?xml"}}},
        Spelling{"declaration", {{"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", ""}}},
        Spelling{"siblings", {{"<files>", "<files/>"}, {"</files>", ""}}},
        Spelling{"filesets", {{"<fileset", "<fileSet"}, {"</fileset", "</fileSet"}}},
        Spelling{"alpha", {{"<alphaMap/>", ""}}},
        Spelling{"alphaPath",
                 {{"<alphaMap/>", "<alphaMap><bitDepth>8</bitDepth><path> </path></alphaMap>"}}},
        Spelling{"version2",
                 {{"level=\"1\" version=\"1.0\"", "geometry=\"1\" color=\"TBD\" version=\"2.0\""}}},
        Spelling{"noVersion", {{" level=\"1\" version=\"1.0\"", ""}}},
        Spelling{
            "capitals",
            {{"<MPCDI", "<mpcdi"}, {"</MPCDI", "</mpcdi"}, {"profile=\"2d\"", "Profile=\"2D\""}}},
        Spelling{"path", {{"a.pfm", "./A.PFM"}}},
        Spelling{"cdata", {{"a.pfm", "\n <![CDATA[a.pfm]]>\n"}}},
        Spelling{"numbers", {{"x=\"0\"", "x=\" +0.000 \""}, {"ysize=\"1\"", "ysize=\"1e0\""}}},
        Spelling{"interpolation", {{"linear", "unknown"}}},
        Spelling{"origin",
                 {{"<interpolation>", "<originof3DData>linear</originof3DData><interpolation>"}}},
        Spelling{"region", {{" x=\"0\" y=\"0\" xsize=\"1\" ysize=\"1\"", ""}}}),
    [](const testing::TestParamInfo<Spelling>& spelling) { return spelling.param.name; });

TEST(Mpcdi, linesMayEndAsInWindowsAndLettersHaveTwoBytes) {
    std::string windows, wide("\xFF\xFE", 2);
    for (const char* c = kManifest; *c != '\0'; ++c) {
        if (*c == '\n') windows += '\r';
        windows += *c;
    }
    expectSame(readText(windows), readText(kManifest));
    for (const char c : with(kManifest, "UTF-8", "UTF-16")) wide += {c, '\0'};
    expectSame(readText(wide), readText(kManifest));
    EXPECT_TRUE(isMpcdi(bytesOf(wide)));
    EXPECT_FALSE(isMpcdi(bytesOf("<GeometryFile/>")));
}

TEST(Mpcdi, theManifestMayHaveAnyNameThatStandsAlone) {
    for (const char* name : {"mpacs.xml", "MPCDI.XML", "mpcdi1_.xml"})
        expectSame(readMpcdi(archiveOf(kManifest, test::smallPfm(), name), "wall.mpcdi"),
                   readText(kManifest));
    const auto two = encodeArchive({{"a.xml", bytesOf(kManifest)}, {"b.xml", bytesOf(kManifest)}});
    EXPECT_THAT(test::complaintOf(two), testing::HasSubstr("wall.mpcdi: has no mpcdi.xml, and 2"));
}

// An archive with a map, and a manifest that names it by a path.
std::vector<std::byte> packed(const std::string& manifest,
                              const std::string& map,
                              const std::string& path) {
    std::string text = kManifest;
    text.replace(text.find("a.pfm"), 5, path);
    return encodeArchive({{manifest, bytesOf(text)},
                          {map, encodePfm(test::smallPfm())},
                          {"__MACOSX/hall/._mpcdi.xml", bytesOf("of a Mac")}});
}

// As an archive that was packed with its folder: names of the manifest are those beside it.
TEST(Mpcdi, theManifestMayLieInAFolderOfTheArchive) {
    const WallFile plain = readMpcdi(archiveOf(kManifest, test::smallPfm()), "wall.mpcdi");
    const auto expectRead = [&](const char* manifest, const char* map, const char* path) {
        SCOPED_TRACE(std::string(manifest) + " " + map + " " + path);
        expectSame(readMpcdi(packed(manifest, map, path), "wall.mpcdi"), plain);
    };
    for (const char* manifest :
         {"hall/mpcdi.xml", "hall/MPCDI.XML", "hall/mpacs.xml", "hall/x.xml"})
        for (const char* path : {"a.pfm", "./A.pfm", "maps\\..\\a.pfm", "hall/a.pfm"})
            expectRead(manifest, "hall/a.pfm", path);
    expectRead("hall/mpcdi.xml", "a.pfm", "a.pfm");
    expectRead("hall/mpcdi.xml", "maps/a.pfm", "../maps/a.pfm");
    expectRead("a/b/mpcdi.xml", "a/b/c/a.pfm", "c\\a.pfm");
    const auto two =
        encodeArchive({{"a/mpcdi.xml", bytesOf(kManifest)}, {"b/MPCDI.xml", bytesOf(kManifest)}});
    EXPECT_EQ(test::complaintOf(two),
              "wall.mpcdi: has 2 manifests, \"a/mpcdi.xml\" and \"b/MPCDI.xml\"; pack each wall by "
              "itself");
    EXPECT_THAT(test::complaintOf(encodeArchive({{"a/b.pfm", {}}})),
                testing::HasSubstr("has no mpcdi.xml, and 0 other xml files"));
}

TEST(Mpcdi, whatIsKeptAndNotObeyedIsSaid) {
    const auto saidOf = [](const std::string& part, const std::string& other) {
        std::string text = kManifest;
        text.replace(text.find(part), part.size(), other);
        return readMpcdi(archiveOf(text, test::smallPfm()), "wall.mpcdi").remarks;
    };
    EXPECT_THAT(saidOf(">linear<", ">linear<"), testing::IsEmpty());
    EXPECT_THAT(
        saidOf(">linear<", ">smooth<"),
        testing::ElementsAre("wall.mpcdi: mpcdi.xml: fileset \"a\": interpolation \"smooth\" is "
                             "taken as linear: export a denser map"));
    EXPECT_THAT(saidOf("<alphaMap/>", "<alphaMap/><shaderMap/>"),
                testing::ElementsAre(
                    testing::HasSubstr("<shaderMap> in <fileset> is kept but not obeyed")));
    EXPECT_THAT(
        saidOf("</MPCDI>", "<extensionSet><extension Name=\"colours\"/></extensionSet></MPCDI>"),
        testing::ElementsAre(testing::HasSubstr("<extension Name=\"colours\"> in <extensionSet>")));
}

TEST(Mpcdi, a3dIsA3AndUnitsBecomeMetres) {
    const std::pair<const char*, float> kUnits[]{{"mm", 0.001F},
                                                 {"cm", 0.01F},
                                                 {"dm", 0.1F},
                                                 {"m", 1},
                                                 {"in", 0.0254F},
                                                 {"ft", 0.3048F},
                                                 {"YD", 0.9144F},
                                                 {"unknown", 1},
                                                 {"2D", 1}};
    for (const auto& [unit, metres] : kUnits) {
        const WallFile wall = readText(
            with(with(kManifest, "\"2d\"", "\"a3d\""),
                 "<interpolation>",
                 std::string("<originOf3DData>floorCenter</originOf3DData><geometricUnit>") + unit +
                     "</geometricUnit><interpolation>"));
        EXPECT_EQ(wall.profile, Profile::Screen);
        EXPECT_EQ(wall.origin, DataOrigin::FloorCentre);
        EXPECT_FLOAT_EQ(wall.channels[0].warp->samples[0].y, 0.75F * metres) << unit;
    }
}

// A pose as a vendor of projectors writes it: Z up, Y forward, no archive, filesets that name
// nothing, one projector with a fisheye whose left angle is positive.
constexpr const char* kPoses = R"(<?xml version="1.0" encoding="utf-8"?>
<MPCDI profile="sl" geometry="2" color="1" date="2026-11-23 14:25:51" version="2.0">
  <display><buffer id="some.cal">
    <region id="SP-X+_01" xResolution="1400" yResolution="1050" x="0" y="0" xsize="1" ysize="1">
      <frustum><yaw>45.5</yaw><pitch>-25</pitch><roll>375</roll><rightAngle>26.5</rightAngle>
        <leftAngle>89.75</leftAngle><upAngle>20.25</upAngle><downAngle>-20.5</downAngle></frustum>
      <coordinateFrame><posx>-0.6</posx><posy>-0.5</posy><posz>0.25</posz>
        <yawx>0</yawx><yawy>0</yawy><yawz>-1</yawz><pitchx>1</pitchx><pitchy>0</pitchy>
        <pitchz>0</pitchz><rollx>0</rollx><rolly>1</rolly><rollz>0</rollz></coordinateFrame>
    </region></buffer></display>
  <files></files>
  <fileset region="SP-X+_01">
    <geometryWarpFile><geometricUnit>m</geometricUnit><path></path></geometryWarpFile>
    <alphaMap><gammaEmbedded>1.0</gammaEmbedded><path></path></alphaMap>
    <distortionMap><path></path></distortionMap>
  </fileset>
</MPCDI>)";

TEST(Mpcdi, aManifestAloneHasPoses) {
    const WallFile wall = readMpcdi(bytesOf(kPoses), "wall.mpcdi.xml");
    ASSERT_EQ(wall.channels.size(), 1U);
    const FileChannel& channel = wall.channels[0];
    EXPECT_EQ(channel.name, "SP-X+_01");
    EXPECT_FALSE(channel.warp || channel.blend || channel.distortion);
    EXPECT_DOUBLE_EQ(channel.frustum->yaw, 45.5 * kDegree);
    EXPECT_DOUBLE_EQ(channel.frustum->roll, 15 * kDegree);
    EXPECT_DOUBLE_EQ(channel.frustum->left, 89.75 * kDegree);
    EXPECT_EQ(channel.coordinateFrame->canonicalPosition(), glm::dvec3(-0.6, 0.25, 0.5));
    for (const int version : {1, 2}) {
        expectSame(rewritten(wall, version), wall);
        EXPECT_THAT(manifestOf(wall, version), testing::HasSubstr("<yaw>45.5</yaw>"));
    }
}

TEST(Mpcdi, anglesAreOfOneTurn) {
    const double half = radiansOf(180);
    EXPECT_EQ(radiansOf(-180), half);
    EXPECT_EQ(radiansOf(540), half);
    EXPECT_DOUBLE_EQ(radiansOf(-179.5), -179.5 * kDegree);
    EXPECT_DOUBLE_EQ(radiansOf(326.25), -33.75 * kDegree);
    EXPECT_EQ(radiansOf(0), 0);
}

// The rectangle of a region is measured from the bottom, as its values are.
TEST(Mpcdi, regionsAreMeasuredFromTheTopHere) {
    const WallFile wall = readText(with(
        kManifest, "y=\"0\" xsize=\"1\" ysize=\"1\"", "y=\"0.07\" xsize=\"0.9\" ysize=\"0.92\""));
    EXPECT_NEAR(wall.channels[0].corner.y, 0.01, 1e-15);
    // v = 0.75 of the top row: 1 - (0.07 + 0.75 * 0.92)
    EXPECT_NEAR(wall.channels[0].warp->samples[0].y, 0.24, 1e-7);
    EXPECT_THAT(manifestOf(wall, 1), testing::HasSubstr("y=\"0.07\" xsize=\"0.9\" ysize=\"0.92\""));
}

TEST(Mpcdi, theProducersRowsMayBeTurnedOver) {
    const WallFile wall = readMpcdi(archiveOf(kManifest), "wall.mpcdi", {.upsideDown = true});
    EXPECT_EQ(wall.channels[0].warp->samples[0].y, 0.875F);
}

TEST(Mpcdi, aSizeThatIsNotSaidIsTheUsersOrTheBuffersOrTheWarps) {
    const std::string unsaid = with(kManifest, " Xresolution=\"4\" Yresolution=\"2\"", "");
    EXPECT_EQ(readText(unsaid).channels[0].sizePixels, glm::ivec2(8, 6));
    EXPECT_EQ(readMpcdi(archiveOf(unsaid), "wall.mpcdi", {.sizePixels = glm::ivec2(7, 5)})
                  .channels[0]
                  .sizePixels,
              glm::ivec2(7, 5));
    const std::string nowhere = with(unsaid, " Xresolution=\"8\" Yresolution=\"6\"", "");
    EXPECT_EQ(readText(nowhere).channels[0].sizePixels, glm::ivec2(4, 2));
    EXPECT_THAT(test::complaintOf(archiveOf(with(nowhere, "a.pfm", ""))),
                testing::HasSubstr("region \"a\" has no resolution; say"));
}

TEST(Mpcdi, aBlackLevelWithoutItsOwnGammaHasTheBlends) {
    const auto png = [](const Mask& mask) {
        return encodePng({mask.size, mask.components, mask.bits, mask.codes}, PngMeaning::Unsaid);
    };
    const Mask blend = test::sampleMask(3, 16, 2.5), black = test::sampleMask(1, 8, 2.5);
    const std::string manifest = with(kManifest,
                                      "<alphaMap/>",
                                      "<alphaMap><path>b.png</path><bitdepth>16</bitdepth>"
                                      "<gammaEmbedded>2.5</gammaEmbedded></alphaMap>"
                                      "<betaMap><path>k.png</path></betaMap>");
    const WallFile wall = readMpcdi(encodeArchive({{"mpcdi.xml", bytesOf(manifest)},
                                                   {"a.pfm", encodePfm(test::smallPfm())},
                                                   {"b.png", png(blend)},
                                                   {"k.png", png(black)}}),
                                    "wall.mpcdi");
    expectSame(*wall.channels[0].blend, blend);
    expectSame(*wall.channels[0].black, black);
}

}  // namespace
}  // namespace aquarama::formats
