// SPDX-License-Identifier: Apache-2.0
#include "common/formats/vendors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/units.h"
#include "tests/common/formats/vendor_samples.h"
#include "tests/support/count_memory.h"

namespace aquarama::formats {
namespace {

using testing::HasSubstr;

const std::string kDome = AQUARAMA_SOURCE_DIR "/../shared/data/dome_nrkp/";

bool withoutData() {
    return !std::filesystem::exists(kDome);
}

SampleBytes dome(const std::string& file) {
    return readWhole(kDome + file, 1 << 24);
}

// Every reader by name; frustum files are tried apart.
struct Reader {
    const char* name;
    bool (*is)(std::span<const std::byte>);
    std::function<WallFile(std::span<const std::byte>, const std::string&, const ReadOptions&)>
        read;
    SampleBytes sample;
    bool binary = false;
};

std::vector<Reader> readers() {
    const auto csv = [](auto bytes, const std::string& source, const ReadOptions& options) {
        return readDomeprojection(bytes, source, options);
    };
    const auto xml = [](auto bytes, const std::string& source, const ReadOptions& options) {
        return readSimcad(bytes, source, options);
    };
    return {{"vioso", isVioso, readVioso, vioso({}), true},
            {"sciss", isSciss, readSciss, sciss(), true},
            {"scalable", isScalable, readScalable, bytesOf(kScalable)},
            {"domeprojection", isDomeprojection, csv, bytesOf(kDomeprojection)},
            {"frustum", isDomeprojection, csv, bytesOf(kFrustum)},
            {"simcad", isSimcad, xml, bytesOf(kSimcad)},
            {"bourke", isPaulBourke, readPaulBourke, bytesOf(kPaulBourke)},
            {"obj", isObj, readObjWarp, bytesOf(kObj)}};
}

const ReadOptions kSmall{glm::ivec2(16, 8), {}, false};

// Why it is refused; empty where it is read.
template <typename Read>
std::string refusalOf(Read read) {
    try {
        static_cast<void>(read());
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string refusalOf(const Reader& reader, const SampleBytes& bytes) {
    return refusalOf([&] { return reader.read(bytes, "hall/left", kSmall); });
}

void expectOneLine(const std::string& refusal) {
    EXPECT_TRUE(refusal.starts_with("hall/left:")) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
    EXPECT_LT(refusal.size(), 200U) << refusal;
}

SampleBytes edited(std::string_view text, std::string_view from, std::string_view to) {
    std::string changed(text);
    changed.replace(changed.find(from), from.size(), to);
    return bytesOf(changed);
}

void expectSample(const Warp& warp, int x, int y, glm::vec3 expected, float within = 1e-6F) {
    const auto i = static_cast<std::size_t>(y * warp.size.x + x);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(warp.samples.at(i)[c], expected[c], within) << x << " " << y << " " << c;
}

// The largest differences between the vertices of two meshes.
struct MeshDifference {
    double place = 0, target = 0;
};

MeshDifference differenceOf(const WarpMesh& a, const WarpMesh& b) {
    EXPECT_EQ(a.vertices.size(), b.vertices.size());
    MeshDifference most;
    for (std::size_t i = 0; i < std::min(a.vertices.size(), b.vertices.size()); ++i)
        for (int c = 0; c < 2; ++c) {
            const auto &one = a.vertices[i], &other = b.vertices[i];
            most.place = std::max(most.place, std::abs(one.place[c] - other.place[c]));
            most.target = std::max(most.target, std::abs(one.target[c] - other.target[c]));
        }
    return most;
}

// Rasterising.

TEST(Rasterised, isLinearWithinTrianglesAndDarkOutside) {
    const WarpMesh mesh{{{{0, 0}, {0, 0, 0}, 0}, {{1, 0}, {1, 0, 0}, 1}, {{0, 1}, {0, 1, 0}, 0}},
                        {{0, 1, 2}}};
    Mask light;
    const Warp warp = rasterised(mesh, {4, 4}, &light);
    ASSERT_EQ(warp.size, glm::ivec2(4, 4));
    EXPECT_EQ(warp.sampling, Sampling::Centres);
    expectSample(warp, 0, 0, {0.125F, 0.125F, 0});
    expectSample(warp, 2, 0, {0.625F, 0.125F, 0});
    expectSample(warp, 1, 2, {0.375F, 0.625F, 0});  // on the edge
    EXPECT_TRUE(std::isnan(warp.samples[3 * 4 + 1].x));
    EXPECT_TRUE(std::isnan(warp.samples[15].x));
    ASSERT_EQ(light.codes.size(), 16U);
    EXPECT_EQ(light.bits, 16);
    EXPECT_EQ(light.codes[2], 40959);  // 0.625
    EXPECT_EQ(light.codes[15], 0);
}

TEST(Rasterised, theLaterTriangleWins) {
    WarpMesh mesh{{{{0, 0}, {1, 0, 0}},
                   {{2, 0}, {1, 0, 0}},
                   {{0, 2}, {1, 0, 0}},
                   {{0, 0}, {2, 0, 0}},
                   {{2, 0}, {2, 0, 0}},
                   {{0, 2}, {2, 0, 0}}},
                  {{0, 1, 2}, {3, 5, 4}}};
    EXPECT_EQ(rasterised(mesh, {2, 2}).samples[0].x, 2);
    std::swap(mesh.triangles[0], mesh.triangles[1]);
    EXPECT_EQ(rasterised(mesh, {2, 2}).samples[0].x, 1);
}

TEST(Rasterised, aGridLeavesNoHoleAlongItsEdges) {
    WarpMesh mesh{{}, gridTriangles(8, 8)};
    for (int i = 0; i < 64; ++i) {
        const glm::dvec2 node(i % 8 / 7.0, i / 8 / 7.0);
        mesh.vertices.push_back({node, {node, 0}});
    }
    for (const glm::ivec2 size : {glm::ivec2(7, 7), glm::ivec2(64, 36), glm::ivec2(191, 107)}) {
        const Warp warp = rasterised(mesh, size);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                expectSample(warp, x, y, glm::vec3((x + 0.5) / size.x, (y + 0.5) / size.y, 0));
    }
}

TEST(Rasterised, trianglesOfNoAreaOrFarAwayAreLeftOut) {
    const WarpMesh mesh{{{{0, 0}, {}},
                         {{1, 1}, {}},
                         {{0.5, 0.5}, {}},
                         {{1e9, 1e9}, {}},
                         {{-1e9, 1e9}, {}},
                         {{-1e9, 1e8}, {}}},
                        {{0, 1, 2}, {0, 0, 1}, {3, 4, 5}}};
    for (const glm::vec3& sample : rasterised(mesh, {8, 8}).samples)
        EXPECT_TRUE(std::isnan(sample.x));
}

// Files of a real dome. Each is read with a picture's size, as some need one.

TEST(VendorFiles, everyOneOfTheDomeIsReadByTheReaderOfItsFormat) {
    if (withoutData()) GTEST_SKIP() << "no data in " << kDome;
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kDome)) {
        const std::string ending = entry.path().extension();
        if (ending != ".sgc" && ending != ".csv" && ending != ".simcad" && ending != ".data")
            continue;
        ++files;
        const SampleBytes bytes = readWhole(entry.path(), 1 << 24);
        int known = 0;
        for (const Reader& reader : readers()) {
            if (!reader.is(bytes) || std::string_view(reader.name) == "frustum") continue;
            ++known;
            const WallFile file = reader.read(bytes, entry.path(), kSmall);
            ASSERT_EQ(file.channels.size(), 1U) << entry.path();
            const FileChannel& channel = file.channels[0];
            EXPECT_EQ(channel.name, entry.path().stem());
            EXPECT_TRUE(channel.warp || channel.frustum) << entry.path();
        }
        EXPECT_EQ(known, 1) << entry.path();
    }
    EXPECT_EQ(files, 16);
}

TEST(VendorFiles, simcadIsTheMeshThatAnotherProgramMadeOfIt) {
    if (withoutData()) GTEST_SKIP() << "no data in " << kDome;
    for (const std::string pair :
         {"simcad_oracle/channel1", "simcad/channel1", "simcad/channel2"}) {
        const SampleBytes xml = dome(pair + "_warp.simcad"), csv = dome(pair + "_warp_mesh.csv");
        const WarpMesh mesh = simcadMesh(xml, "x");
        ASSERT_EQ(mesh.vertices.size(), 33U * 33U);
        const MeshDifference difference = differenceOf(mesh, domeprojectionMesh(csv, "c"));
        EXPECT_LT(difference.place, 1e-6) << pair;
        EXPECT_LT(difference.target, 1e-6) << pair;
    }
}

TEST(VendorFiles, sgcAndCsvOfAChannelAreOneMeshAndOnePose) {
    if (withoutData()) GTEST_SKIP() << "no data in " << kDome;
    for (const std::string channel : {"channel1", "channel2"}) {
        const SampleBytes sgc = dome("simcad/" + channel + "_warp_u3.sgc");
        const SampleBytes csv = dome("simcad/" + channel + "_warp_mesh.csv");
        const SampleBytes frustum = dome("simcad/" + channel + "_warp_frustum.csv");
        const MeshDifference difference =
            differenceOf(scissMesh(sgc, "s"), domeprojectionMesh(csv, "c"));
        EXPECT_LT(difference.place, 1e-6);
        EXPECT_LT(difference.target, 1e-6);

        const WallFile one = readSciss(sgc, "s", kSmall);
        const WallFile other = readDomeprojection(csv, "c", kSmall, {"f", frustum});
        EXPECT_EQ(one.profile, Profile::View);
        EXPECT_EQ(other.profile, Profile::View);
        const Frustum a = one.channels[0].frustum.value(), b = other.channels[0].frustum.value();
        EXPECT_NEAR(a.yaw, (channel == "channel1" ? -45 : 45) * kDegree, 1e-6);
        for (const auto part : {&Frustum::yaw,
                                &Frustum::pitch,
                                &Frustum::roll,
                                &Frustum::left,
                                &Frustum::right,
                                &Frustum::down,
                                &Frustum::up})
            EXPECT_NEAR(a.*part, b.*part, 1e-6);
    }
}

// A triangle more or less at the border, and quads that are cut along the other diagonal.
TEST(VendorFiles, warpsOfAChannelAgreeInAllItsFormats) {
    if (withoutData()) GTEST_SKIP() << "no data in " << kDome;
    const ReadOptions options{glm::ivec2(512, 320), {}, false};
    const SampleBytes sgc = dome("simcad/channel1_warp_u3.sgc");
    const SampleBytes csv = dome("simcad/channel1_warp_mesh.csv");
    const SampleBytes xml = dome("simcad/channel1_warp.simcad");
    const Warp a = *readDomeprojection(csv, "c", options).channels[0].warp;
    const std::vector<Warp> others{*readSimcad(xml, "x", options).channels[0].warp,
                                   *readSciss(sgc, "s", options).channels[0].warp};
    for (const Warp& b : others) {
        double most = 0;
        std::size_t lit = 0, litOnce = 0;
        for (std::size_t i = 0; i < a.samples.size(); ++i) {
            const bool here = !std::isnan(a.samples[i].x), there = !std::isnan(b.samples[i].x);
            lit += here && there ? 1U : 0U;
            litOnce += here != there ? 1U : 0U;
            if (!here || !there) continue;
            for (int c = 0; c < 2; ++c)
                most = std::max(most, std::abs(double{a.samples[i][c]} - double{b.samples[i][c]}));
        }
        EXPECT_GT(lit, a.samples.size() * 8 / 10);
        EXPECT_LT(litOnce, a.samples.size() / 1000);
        EXPECT_LT(most, &b == &others[0] ? 1e-5 : 5e-4);
        RecordProperty("most", std::to_string(most));
    }
}

TEST(VendorFiles, sgcOfTheFirstVersionIsAnEvenGrid) {
    if (withoutData()) GTEST_SKIP() << "no data in " << kDome;
    const FileChannel channel =
        readSciss(dome("sciss/channel1_planar.sgc"), "s", {}).channels.at(0);
    ASSERT_TRUE(channel.warp);
    EXPECT_EQ(channel.warp->sampling, Sampling::Nodes);
    EXPECT_EQ(channel.warp->size, glm::ivec2(91, 91));
    expectSample(*channel.warp, 0, 90, {0, 1 - 0.03653357F, 0});
    const Frustum& frustum = channel.frustum.value();
    EXPECT_NEAR(frustum.pitch, 39.62 * kDegree, 0.01 * kDegree);
    EXPECT_NEAR(frustum.down, -32.10784149 * kDegree, 1e-6);
    EXPECT_NEAR(frustum.right, 47.51991653 * kDegree, 1e-6);
}

TEST(VendorFiles, theMeshOfASphericalMirrorHasItsBlend) {
    if (withoutData()) GTEST_SKIP() << "no data in " << kDome;
    const FileChannel channel =
        readPaulBourke(dome("paulbourke_standard_16x9.data"), "p", {}).channels.at(0);
    EXPECT_EQ(channel.warp->sampling, Sampling::Nodes);
    EXPECT_EQ(channel.warp->size, glm::ivec2(100, 60));
    expectSample(*channel.warp, 0, 59, {0.160825F, 1 - 0.86737F, 0});
    expectSample(*channel.warp, 98, 0, {0.5436F, 1 - 0.963886F, 0});
    const Mask& blend = channel.blend.value();
    EXPECT_EQ(blend.size, glm::ivec2(792, 472));
    EXPECT_NEAR(blend.codes[static_cast<std::size_t>(471) * 792] / 65535.0, 0.5305, 0.01);
}

// What each sample says.

TEST(Vioso, recordsAreFromTheTopAndTheBlendFollowsThem) {
    const SampleBytes bytes = vioso({.blocks = 2}, {viosoBitmap(24, false, 200)});
    const WallFile file = readVioso(bytes, "v", {});
    EXPECT_EQ(file.profile, Profile::Content);
    ASSERT_EQ(file.channels.size(), 1U);
    const FileChannel& channel = file.channels[0];
    EXPECT_EQ(channel.name, "left");
    EXPECT_EQ(channel.sizePixels, glm::ivec2(2, 2));
    EXPECT_EQ(channel.warp->sampling, Sampling::Centres);
    expectSample(*channel.warp, 0, 0, {0.25F, 0.125F, 0});
    expectSample(*channel.warp, 0, 1, {0.25F, 0.875F, 0});
    EXPECT_TRUE(std::isnan(channel.warp->samples[3].x));
    EXPECT_EQ(channel.blend->components, 1);
    EXPECT_EQ(channel.blend->bits, 8);
    EXPECT_EQ(channel.blend->codes, (std::vector<std::uint16_t>{0, 0, 200, 0}));
    EXPECT_FALSE(channel.black);
    const WallFile turned = readVioso(bytes, "v", {{}, {}, true});
    expectSample(*turned.channels[0].warp, 0, 0, {0.25F, 0.875F, 0});
}

TEST(Vioso, bitmapsOfAllDepthsSayTheSame) {
    const std::vector<std::pair<int, std::uint64_t>> depths{
        {24, 51}, {32, 51}, {48, 13107}, {64, 13107}, {96, 0x3e4ccccd}, {128, 0x3e4ccccd}};
    for (const auto& [bits, code] : depths)
        for (const bool topFirst : {false, true}) {
            const SampleBytes bytes = vioso({.blocks = 2}, {viosoBitmap(bits, topFirst, code)});
            const Mask blend = readVioso(bytes, "v", {}).channels[0].blend.value();
            const std::size_t lower = 2;
            EXPECT_NEAR(blend.codes[lower] / double((1 << blend.bits) - 1), 0.2, 1e-5) << bits;
            EXPECT_EQ(blend.codes[0], 0) << bits;
            EXPECT_EQ(blend.components, 1) << bits;
        }
}

// Windows bitmaps have blue first, except those of four deep colours, as the vendor reads them.
TEST(Vioso, coloursOfABitmapAreTold) {
    for (const auto& [bits, first] : {std::pair{24, 2U}, std::pair{48, 2U}, std::pair{64, 0U}}) {
        SampleBytes bitmap = viosoBitmap(bits, true, 0);
        bitmap[bitmap.size() - (bits == 24 ? 8U : 2U * static_cast<unsigned>(bits) / 8U)] =
            std::byte{7};
        const Mask blend =
            readVioso(vioso({.blocks = 2}, {bitmap}), "v", {}).channels[0].blend.value();
        EXPECT_EQ(blend.components, 3);
        EXPECT_EQ(blend.codes[6 + first], 7) << bits;
    }
}

TEST(Vioso, theBlackLevelIsScaledByItsHeader) {
    const std::vector<SampleBytes> bitmaps{viosoBitmap(24, false, 255),
                                           viosoBitmap(24, false, 255)};
    const SampleVioso sample{.blocks = 3, .flags = 0x20, .blackScale = 0.25F};
    const FileChannel channel = readVioso(vioso(sample, bitmaps), "v", {}).channels[0];
    EXPECT_EQ(channel.blend->codes[2], 255);
    EXPECT_EQ(channel.black->bits, 16);
    EXPECT_EQ(channel.black->codes[2], 16384);
    const FileChannel unset = readVioso(vioso({.blocks = 3}, bitmaps), "v", {}).channels[0];
    EXPECT_FALSE(unset.black);
}

TEST(Vioso, pointsOfTheScreenAndSeveralChannelsAreRead) {
    const SampleVioso sample{.blocks = 3, .points = true};
    const SampleBytes bytes = vioso(sample, {viosoBitmap(24, false, 9), viosoWarp(sample)});
    const WallFile file = readVioso(bytes, "v", {});
    EXPECT_EQ(file.profile, Profile::Screen);
    ASSERT_EQ(file.channels.size(), 2U);
    expectSample(*file.channels[1].warp, 1, 0, {0.75F, 0.125F, 3});
    EXPECT_TRUE(file.channels[0].blend);
    EXPECT_FALSE(file.channels[1].blend);
    EXPECT_EQ(readVioso(viosoWarp({}), "v", {}).channels.size(), 1U);  // without a set's header
}

TEST(Vioso, theBorderFlagCutsAHundredthOfTheContent) {
    const FileChannel channel = readVioso(vioso({.flags = 0x8}), "v", {}).channels[0];
    expectSample(*channel.warp, 0, 0, {0.245F, 0.1175F, 0});
}

TEST(Vioso, whatCannotBeMeantIsNamed) {
    const auto refusal = [](const SampleBytes& bytes) {
        return refusalOf([&] { return readVioso(bytes, "v.vwf", {}); });
    };
    EXPECT_THAT(refusal(vioso({.flags = 0x400})), HasSubstr("encrypted"));
    EXPECT_THAT(refusal(vioso({.flags = 0x1})), HasSubstr("compressed"));
    EXPECT_THAT(refusal(vioso({.dataBytes = 48})), HasSubstr("takes 48 bytes"));
    EXPECT_THAT(refusal(vioso({.width = 0})), HasSubstr("0 by 2 pixels"));
    EXPECT_THAT(refusal(vioso({.blocks = 4000000000U})), HasSubstr("copy it anew"));
    EXPECT_THAT(refusal(vioso({.width = 0x80000000U, .height = 0x80000000U})), HasSubstr("pixels"));
    EXPECT_THAT(refusal(vioso({.width = 8192, .height = 4096, .dataBytes = 1U << 29})),
                HasSubstr("33554432 records of the warp follow"));
    EXPECT_THAT(refusal(vioso({.blocks = 2}, {viosoWarp({.points = true})})), HasSubstr("points"));
    EXPECT_THAT(refusal(vioso({.blocks = 2}, {viosoBitmap(16, false, 0)})), HasSubstr("16 bits"));
}

TEST(Sciss, placesAreFromTheTopAndTexturesFromTheBottom) {
    const WallFile file = readSciss(sciss(), "hall/left.sgc", {});
    EXPECT_EQ(file.profile, Profile::View);
    const FileChannel& channel = file.channels.at(0);
    EXPECT_EQ(channel.name, "left");
    EXPECT_EQ(channel.warp->sampling, Sampling::Nodes);
    expectSample(*channel.warp, 0, 0, {0.25F, 0.25F, 0});
    expectSample(*channel.warp, 1, 1, {0.75F, 0.75F, 0});
    const Frustum& frustum = channel.frustum.value();
    EXPECT_NEAR(frustum.yaw, -90 * kDegree, 1e-6);
    EXPECT_NEAR(frustum.pitch, 0, 1e-6);
    EXPECT_NEAR(frustum.roll, 0, 1e-6);
    EXPECT_NEAR(frustum.up, 30 * kDegree, 1e-9);
    EXPECT_NEAR(frustum.down, -20 * kDegree, 1e-9);
    EXPECT_NEAR(frustum.left, -45 * kDegree, 1e-9);
    EXPECT_EQ(channel.coordinateFrame->position, glm::dvec3(1, 2, 3));
}

TEST(Sciss, anUnevenMeshNeedsThePicturesSize) {
    const SampleBytes uneven = sciss({.version = 2, .first = 5, .second = 4, .right = 0.5F});
    EXPECT_THAT(refusalOf([&] { return readSciss(uneven, "a.sgc", {}); }),
                HasSubstr("give --size WIDTHxHEIGHT"));
    const FileChannel channel = readSciss(uneven, "a.sgc", kSmall).channels.at(0);
    EXPECT_EQ(channel.sizePixels, glm::ivec2(16, 8));
    EXPECT_EQ(channel.warp->sampling, Sampling::Centres);
    expectSample(*channel.warp, 0, 0, {0.28125F, 0.28125F, 0});
    EXPECT_TRUE(std::isnan(channel.warp->samples[8].x));
}

TEST(Sciss, whatCannotBeMeantIsNamed) {
    const auto refusal = [](const SampleSciss& sample) {
        return refusalOf([&] { return readSciss(sciss(sample), "a.sgc", kSmall); });
    };
    EXPECT_THAT(refusal({.type = 1}), HasSubstr("cube map"));
    EXPECT_THAT(refusal({.type = 7}), HasSubstr("mapping 7"));
    EXPECT_THAT(refusal({.version = 50}), HasSubstr("version 50"));
    EXPECT_THAT(refusal({.version = 2, .first = 9, .second = 4}), HasSubstr("strip"));
    EXPECT_THAT(refusal({.first = 65536, .second = 65536}), HasSubstr("4294967296 vertices"));
    EXPECT_THAT(refusal({.first = 2000, .second = 2000}), HasSubstr("4000000 vertices follow"));
    EXPECT_THAT(refusal({.right = NAN}), HasSubstr("no number"));
}

TEST(Sciss, anglesOfEveryRotationComeBack) {
    for (const double yaw : {-170.0, -45.0, 0.0, 60.0, 179.0})
        for (const double pitch : {-80.0, 0.0, 39.5, 89.0})
            for (const double roll : {-120.0, -5.0, 0.0, 14.0}) {
                const auto about = [](glm::dvec3 axis, double degrees) {
                    return glm::angleAxis(degrees * kDegree, axis);
                };
                const glm::dquat q =
                    about({0, 1, 0}, -yaw) * about({1, 0, 0}, pitch) * about({0, 0, 1}, -roll);
                const Frustum frustum = turned(q.x, q.y, q.z, q.w);
                EXPECT_NEAR(frustum.yaw, yaw * kDegree, 1e-9);
                EXPECT_NEAR(frustum.pitch, pitch * kDegree, 1e-9);
                EXPECT_NEAR(frustum.roll, roll * kDegree, 1e-9);
            }
}

TEST(Scalable, isPixelsFromTheBottomWithItsFrustum) {
    const WallFile file = readScalable(bytesOf(kScalable), "left.ol", {});
    EXPECT_EQ(file.profile, Profile::View);
    const FileChannel& channel = file.channels.at(0);
    EXPECT_EQ(channel.sizePixels, glm::ivec2(8, 4));
    expectSample(*channel.warp, 0, 0, {0.25F, 0.25F, 0});
    expectSample(*channel.warp, 1, 1, {0.75F, 0.75F, 0});
    EXPECT_NEAR(channel.frustum->pitch, 10 * kDegree, 1e-9);
    EXPECT_NEAR(channel.frustum->down, -30 * kDegree, 1e-9);
    EXPECT_EQ(channel.coordinateFrame->position, glm::dvec3(1, 2, 3));
    ASSERT_EQ(channel.blend->size, glm::ivec2(8, 4));
    EXPECT_EQ(channel.blend->gamma, 2);
    EXPECT_EQ(channel.blend->codes[0], 8192);       // an eighth
    EXPECT_EQ(channel.blend->codes[3 * 8], 57343);  // seven of them, below
}

TEST(Scalable, whatCannotBeMeantIsNamedWithItsLine) {
    const auto refusal = [](std::string_view from, std::string_view to) {
        return refusalOf([&] { return readScalable(edited(kScalable, from, to), "a.ol", {}); });
    };
    EXPECT_THAT(refusal("[ 0 3 2 ]", "[ 0 3 4 ]"), HasSubstr("a.ol:31: needs a whole number"));
    EXPECT_THAT(refusal("VERTICES 4", "VERTICES 4000000000"), HasSubstr("a.ol:2:"));
    EXPECT_THAT(refusal("VERTICES 4", "VERTICES 5"), HasSubstr("4 of 5 vertices"));
    EXPECT_THAT(refusal("FACES 2", "FACES 1"), HasSubstr("one face more"));
    EXPECT_THAT(refusal("NORMALIZED", "ABSOLUTE"), HasSubstr("a.ol:4:"));
    EXPECT_THAT(refusal("0 0 255", "0 inf 255"), HasSubstr("no number"));
    EXPECT_THAT(refusal("NATIVEXRES 8", "NATIVEXRES 4000000000"), HasSubstr("NATIVEXRES"));
    EXPECT_THAT(refusal("GAMMA 2.0", "VERTICES 3"), HasSubstr("second count"));
}

// With lines before its vertices.
WallFile scalableWith(const std::string& lines) {
    return readScalable(edited(kScalable, "NATIVEXRES", lines + "NATIVEXRES"), "a.ol", {});
}

TEST(Scalable, keysThatAreOnAndNotObeyedAreSaidWithTheirLine) {
    for (const char* key : {"APPLY_MASK 1",
                            "APPLY_BLACK_LEVEL 1",
                            "APPLY_COLOR 1",
                            "USE_SPHERE_SAMPLE_COORDINATE_SYSTEM 1",
                            "FRUSTUM_EULER_ANGLES 1",
                            "DO_NO_WARP 1",
                            "APPLY_MASK TRUE",
                            "SAMPLING NEAREST",
                            "PROJECTION ORTHOGRAPHIC",
                            "SOME_LATER_KEY 0.5"}) {
        const WallFile file = scalableWith(std::string(key) + "\n");
        ASSERT_EQ(file.remarks.size(), 1U) << key;
        EXPECT_THAT(file.remarks[0], testing::StartsWith("a.ol:21: " + std::string(key) + ": "));
        EXPECT_THAT(file.remarks[0], testing::ContainsRegex(": .*(:|,) [a-z]")) << "what to do";
    }
    const WallFile off = scalableWith(
        "APPLY_MASK 0\nAPPLY_COLOR 0.0\nDO_NO_WARP FALSE\nFRUSTUM_EULER_YAW 15\nLABEL "
        "3\nSUBVERSION "
        "5\n");
    EXPECT_THAT(off.remarks, testing::IsEmpty());
    EXPECT_THAT(readScalable(bytesOf(kScalable), "a.ol", {}).remarks, testing::IsEmpty());
}

TEST(Scalable, noWarpLeavesTheBlendAlone) {
    const FileChannel plain = readScalable(bytesOf(kScalable), "a.ol", {}).channels.at(0);
    const FileChannel even = scalableWith("DO_NO_WARP 1\n").channels.at(0);
    expectSample(*even.warp, 0, 0, {0, 0, 0});
    expectSample(*even.warp, 1, 1, {1, 1, 0});
    EXPECT_EQ(even.blend->codes, plain.blend->codes);
}

TEST(Vendors, whatIsPassedOverIsSaid) {
    const auto said = [](const WallFile& file) {
        return file.remarks.empty() ? "" : file.remarks[0];
    };
    EXPECT_THAT(
        said(readDomeprojection(
            bytesOf("x;y;u;v;column;row;alpha\n0;0;0;0;0;0;1\n1;0;1;0;1;0;1\n0;1;0;1;0;1;1\n"
                    "1;1;1;1;1;1;0\n"),
            "a.csv",
            {})),
        testing::StartsWith("a.csv:1: column \"alpha\" is passed over: "));
    EXPECT_THAT(said(readPaulBourke(edited(kPaulBourke, "2\n", "4\n"), "a.data", {})),
                testing::StartsWith("a.data:1: mesh type 4 is taken as rectangular"));
    EXPECT_THAT(
        said(readSimcad(edited(kSimcad, "</GeometryFile>", "<Blend/></GeometryFile>"), "a", {})),
        testing::StartsWith("a: <Blend> is passed over: "));
    SampleBytes longer = sciss();
    longer.resize(longer.size() + 7);
    EXPECT_THAT(said(readSciss(longer, "a.sgc", kSmall)),
                testing::HasSubstr(": 7 bytes behind the mesh are passed over: "));
    EXPECT_THAT(said(readObjWarp(bytesOf(std::string(kObj) + "curv 0 1 1 2\n"), "a.obj", {})),
                "a.obj:13: \"curv\" is passed over: export the surface as triangles");
    for (const Reader& reader : readers())
        EXPECT_EQ(said(reader.read(reader.sample, "hall/left", kSmall)), "") << reader.name;
}

TEST(Vendors, aTextOfTwoBytesALetterIsNamed) {
    std::string wide = "\xFF\xFE";
    for (const char letter : kObj) (wide += letter) += '\0';
    EXPECT_EQ(refusalOf([&] { return readWallFile(bytesOf(wide), "a.obj"); }),
              "a.obj: is saved as UTF-16, or is no wall file; save it as UTF-8");
}

TEST(Vendors, decimalCommasAreNamed) {
    EXPECT_THAT(
        refusalOf([] {
            return readDomeprojection(
                edited(kDomeprojection, "0.5;0;0.5", "0,5;0;0.5"), "a.csv", {});
        }),
        HasSubstr("a.csv:3: holds what is no number from -1e9 to 1e9, \"0,5\" (0.5 would be "
                  "one)"));
}

TEST(Domeprojection, isFromTheTopLeft) {
    const WallFile file = readDomeprojection(bytesOf(kDomeprojection), "a_mesh.csv", {});
    EXPECT_EQ(file.profile, Profile::Content);
    EXPECT_EQ(file.channels[0].warp->size, glm::ivec2(3, 2));
    expectSample(*file.channels[0].warp, 2, 0, {0.9F, 0.2F, 0});
    expectSample(*file.channels[0].warp, 0, 1, {0.1F, 0.8F, 0});
    const WallFile turned = readDomeprojection(bytesOf(kDomeprojection), "a.csv", {{}, {}, true});
    expectSample(*turned.channels[0].warp, 2, 0, {0.9F, 0.8F, 0});
}

TEST(Domeprojection, theFrustumIsGivenOutwardOrSigned) {
    const SampleBytes outward = bytesOf(kFrustum);
    const SampleBytes asSigned = edited(kFrustum, "50;40;-7;70", "-50;40;7;70");
    for (const SampleBytes& bytes : {outward, asSigned}) {
        const WallFile file =
            readDomeprojection(bytesOf(kDomeprojection), "a.csv", {}, {"f.csv", bytes});
        EXPECT_EQ(file.profile, Profile::View);
        const Frustum& frustum = file.channels[0].frustum.value();
        EXPECT_NEAR(frustum.yaw, -45 * kDegree, 1e-9);
        EXPECT_NEAR(frustum.roll, 5 * kDegree, 1e-9);
        EXPECT_NEAR(frustum.left, -50 * kDegree, 1e-9);
        EXPECT_NEAR(frustum.right, 40 * kDegree, 1e-9);
        EXPECT_NEAR(frustum.up, 70 * kDegree, 1e-9);
        EXPECT_NEAR(frustum.down, 7 * kDegree, 1e-9);
    }
    EXPECT_THAT(refusalOf([&] {
                    return readDomeprojection(edited(kFrustum, "50;40", "90;40"), "f.csv", {});
                }),
                HasSubstr("f.csv:2: left and right enclose no picture"));
}

TEST(Domeprojection, aVertexIsThereOnce) {
    const auto refusal = [](std::string_view from, std::string_view to) {
        return refusalOf(
            [&] { return readDomeprojection(edited(kDomeprojection, from, to), "a.csv", {}); });
    };
    EXPECT_THAT(refusal(";2;1\n", ";1;1\n"), HasSubstr("twice"));
    EXPECT_THAT(refusal("1;1;0.9;0.8;2;1\n", ""), HasSubstr("3 by 2 has 5 vertices"));
    EXPECT_THAT(refusal(";2;1\n", ";4000000000;1\n"), HasSubstr("a.csv:7:"));
    EXPECT_THAT(refusal(";2;1\n", ";4000000;4000000\n"), HasSubstr("has 6 vertices"));
    EXPECT_THAT(refusal("0;0;0.1", "0;nan;0.1"), HasSubstr("a.csv:2: holds what is no number"));
    EXPECT_THAT(refusal("v;column", "w;column"), HasSubstr("no column \"v\""));
}

TEST(Domeprojection, theFrustumLiesBesideTheMesh) {
    EXPECT_EQ(frustumPathBeside("a.b/channel1_warp_mesh.csv"), "a.b/channel1_warp_frustum.csv");
    EXPECT_EQ(frustumPathBeside("channel1_warp.simcad"), "channel1_warp_frustum.csv");
}

TEST(Simcad, offsetsArePartsOfTheirRange) {
    const WarpMesh mesh = simcadMesh(bytesOf(kSimcad), "a");
    ASSERT_EQ(mesh.vertices.size(), 9U);
    EXPECT_EQ(mesh.vertices[4].place, glm::dvec2(0.75, 0.625));
    EXPECT_EQ(mesh.vertices[4].target, glm::dvec3(0.5, 0.5, 0));
    EXPECT_EQ(mesh.vertices[5].place, glm::dvec2(1, 0.5));
    const FileChannel channel = readSimcad(bytesOf(kSimcad), "a", {}).channels.at(0);
    EXPECT_EQ(channel.sizePixels, glm::ivec2(16, 8));
    EXPECT_EQ(channel.warp->size, glm::ivec2(16, 8));
    const FileChannel even =
        readSimcad(edited(kSimcad, "0 0 0 0 4 0", "0 0 0 0 0 0"), "a", {}).channels.at(0);
    EXPECT_EQ(even.warp->sampling, Sampling::Centres);  // y still is bent
    const SampleBytes plain = bytesOf(
        "<GeometryFile><GeometryDefinition><X-FlatParameters range='9'>0 0 0 0</X-FlatParameters>"
        "<Y-FlatParameters range='9'>0 0 0 0</Y-FlatParameters></GeometryDefinition>"
        "</GeometryFile>");
    EXPECT_EQ(readSimcad(plain, "a", {}).channels[0].warp->sampling, Sampling::Nodes);
}

TEST(Simcad, whatCannotBeMeantIsNamedWithItsElement) {
    const auto refusal = [](std::string_view from, std::string_view to) {
        return refusalOf([&] { return readSimcad(edited(kSimcad, from, to), "a", {}); });
    };
    EXPECT_THAT(refusal("0 0 0 0 4", "0 0 0 4"), HasSubstr("8 offsets in x and 9 in y"));
    EXPECT_THAT(refusal("4", "1e300"), HasSubstr("<X-FlatParameters>: value 5"));
    EXPECT_THAT(refusal("range=\"8\"", "range=\"0\""), HasSubstr("<Y-FlatParameters>"));
    EXPECT_THAT(refusal("</GeometryFile>", ""), HasSubstr("no whole XML"));
    EXPECT_THAT(refusal("<GeometryDefinition>", "<X></X><GeometryDefinition>"), "");
}

TEST(PaulBourke, isFromTheBottomWithTheLightOfItsVertices) {
    const FileChannel channel = readPaulBourke(bytesOf(kPaulBourke), "a", {}).channels.at(0);
    EXPECT_EQ(channel.warp->size, glm::ivec2(3, 2));
    expectSample(*channel.warp, 0, 0, {0.1F, 0.2F, 0});
    expectSample(*channel.warp, 2, 1, {0.9F, 0.8F, 0});
    ASSERT_EQ(channel.blend->size, glm::ivec2(16, 8));
    EXPECT_EQ(channel.blend->gamma, 2.2);
    EXPECT_EQ(channel.blend->codes[0], 63487);  // 1 - 0.5 / 16
    EXPECT_EQ(channel.blend->codes[7], 34815);  // 0.5 + 0.5 / 16
}

TEST(PaulBourke, cellsAtAHiddenVertexAreDark) {
    const SampleBytes bytes = edited(kPaulBourke, "-2 1 0.1 0.8 1", "-2 1 0.1 0.8 -1");
    const FileChannel channel = readPaulBourke(bytes, "a", {}).channels.at(0);
    EXPECT_TRUE(std::isnan(channel.warp->samples[0].x));
    EXPECT_EQ(channel.blend->codes[0], 0);
    EXPECT_GT(channel.blend->codes[12], 0);
    const ReadOptions wide{glm::ivec2(16, 4), {}, false};  // the mesh does not reach its borders
    const FileChannel sized = readPaulBourke(bytes, "a", wide).channels.at(0);
    EXPECT_TRUE(std::isnan(sized.warp->samples[5].x));
    EXPECT_FALSE(std::isnan(sized.warp->samples[10].x));
    EXPECT_TRUE(std::isnan(sized.warp->samples[15].x));
}

TEST(PaulBourke, theSeamOfAPolarMeshIsClosed) {
    const std::string_view ring =
        "1\n3 2\n-0.1 -0.1 0 0 1\n0.1 -0.1 0 0 1\n0 0.1 0 0 1\n-1 -1 1 1 1\n1 -1 1 1 1\n0 1 1 1 "
        "1\n";
    const ReadOptions square{glm::ivec2(9, 9), {}, false};
    const auto left = [&](std::string_view text) {
        return readPaulBourke(bytesOf(text), "a", square).channels[0].warp->samples[4 * 9 + 2].x;
    };
    EXPECT_FALSE(std::isnan(left(ring)));
    const std::string open = "2" + std::string(ring.substr(1));
    EXPECT_TRUE(std::isnan(left(open)));
}

TEST(PaulBourke, countsAreChecked) {
    const auto refusal = [](std::string_view from, std::string_view to) {
        return refusalOf([&] { return readPaulBourke(edited(kPaulBourke, from, to), "a", {}); });
    };
    EXPECT_THAT(refusal("3 2", "3 3"), HasSubstr("6 of 9 vertices"));
    EXPECT_THAT(refusal("3 2", "2 2"), HasSubstr("a:7: is one vertex too many"));
    EXPECT_THAT(refusal("3 2", "4000000000 2"), HasSubstr("a:2:"));
    EXPECT_THAT(refusal("3 2", "4000000 4000000"), HasSubstr("no mesh has"));
    EXPECT_THAT(refusal("-2 1 0.1 0.8 1", "-2 1 0.1 0.8"), HasSubstr("a:6: needs the five"));
}

TEST(Obj, facesBecomeTrianglesOfPointsWithTheirTextures) {
    const TriangleMesh mesh = readObj(bytesOf(kObj), "a.obj");
    ASSERT_EQ(mesh.points.size(), 4U);
    ASSERT_EQ(mesh.textures.size(), 4U);
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(mesh.points[2], glm::dvec3(2, 1, -3));
    EXPECT_EQ(mesh.textures[2], glm::dvec2(1, 1));
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
    const TriangleMesh last =
        readObj(bytesOf("v 0 0 0\nv 1 0 0\nv 9 9 9\nv 0 1 0 0.5\nf -4 -3 -1\n"), "b.obj");
    EXPECT_TRUE(last.textures.empty());
    ASSERT_EQ(last.points.size(), 3U);
    EXPECT_EQ(last.points[2], glm::dvec3(0, 1, 0));
}

// By a backslash, whatever ends the lines; also twice, at any blank, and before the end of the
// file.
TEST(Obj, linesGoOnInTheNext) {
    const TriangleMesh whole = readObj(bytesOf(kObj), "a.obj");
    for (const char* face : {"f 1/1/1 2/2/1 \\\n  3/3/1 4/4/1\n",
                             "f 1/1/1 2/2/1 \\\r\n3/3/1 4/4/1\r\n",
                             "f 1/1/1\\\n2/2/1 \\\n\\\n3/3/1 \\ \n 4/4/1",
                             "f \\\r1/1/1 2/2/1 3/3/1 4/4/1\r",
                             "f 1/1/1 2/2/1 3/3/1 4/4/1 \\",
                             "f 1/1 2/2 3/3 4/4 # the screen",
                             "f -4/-4 -3/-3 \\\n -2/-2 -1/-1\n"}) {
        const std::string text = std::string(kObj.substr(0, kObj.find("f 1/1"))) + face;
        const TriangleMesh mesh = readObj(bytesOf(text), "a.obj");
        EXPECT_EQ(mesh.points, whole.points) << face;
        EXPECT_EQ(mesh.triangles, whole.triangles) << face;
        EXPECT_THAT(mesh.remarks, testing::IsEmpty()) << face;
    }
    const TriangleMesh cut =
        readObj(bytesOf("# from C:\\models\\\nv 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 2 3\n"), "b");
    EXPECT_EQ(cut.points.size(), 3U) << "a comment joins nothing";
    EXPECT_THAT(
        refusalOf([] { return readObj(bytesOf("v 0 0 0\nv 1 0 \\\n\\\n0\nf 1 \\\n2 5\n"), "b"); }),
        HasSubstr("b:5: a face names"))
        << "where it begins";
}

TEST(Obj, asAWarpItsTexturesArePlacesOfThePicture) {
    const WallFile file = readObjWarp(bytesOf(kObj), "a.obj", {});
    EXPECT_EQ(file.profile, Profile::Screen);
    const Warp& warp = file.channels.at(0).warp.value();
    EXPECT_EQ(warp.sampling, Sampling::Nodes);
    expectSample(warp, 0, 0, {-2, 1, -3});
    expectSample(warp, 1, 1, {2, 0, -3});
}

TEST(Obj, whatCannotBeMeantIsNamedWithItsLine) {
    const auto refusal = [](std::string_view text) {
        return refusalOf([&] { return readObjWarp(bytesOf(text), "a.obj", kSmall); });
    };
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(refusal(points + "f 1 2 3\n"), HasSubstr("no texture coordinates (vt)"));
    EXPECT_THAT(refusal(points + "f 1 2 4\n"), HasSubstr("a.obj:4: a face names"));
    EXPECT_THAT(refusal(points + "f 1 2 0\n"), HasSubstr("a.obj:4: a face names"));
    EXPECT_THAT(refusal(points + "f 1 2 -4\n"), HasSubstr("a.obj:4: a face names"));
    EXPECT_THAT(refusal(points + "f 1 2 4000000000\n"), HasSubstr("a.obj:4: a face names"));
    EXPECT_THAT(refusal(points + "f 1 2 2\n"), HasSubstr("a.obj:4: a face has one point twice"));
    EXPECT_THAT(refusal(points + "f 1 2\n"), HasSubstr("fewer than three"));
    EXPECT_THAT(refusal(points + "vt 0 0\nf 1/1 2/1 3\n"), HasSubstr("where other faces"));
    EXPECT_THAT(refusal(points), HasSubstr("no face"));
    EXPECT_THAT(refusal("v 0 0 nan\n"), HasSubstr("a.obj:1:"));
}

// What all promise.

TEST(Vendors, aFileIsRecognisedByOneReader) {
    for (const Reader& mine : readers())
        for (const Reader& reader : readers()) {
            const bool same = reader.is == mine.is;
            EXPECT_EQ(reader.is(mine.sample), same) << reader.name << " of " << mine.name;
        }
}

TEST(Vendors, lineEndsOfOldMacsChangeNothing) {
    for (const Reader& reader : readers()) {
        if (reader.binary) continue;
        SampleBytes changed = reader.sample;
        std::ranges::replace(changed, std::byte{'\n'}, std::byte{'\r'});
        EXPECT_TRUE(reader.is(changed)) << reader.name;
        EXPECT_EQ(refusalOf(reader, changed), "") << reader.name;
    }
}

TEST(Vendors, windowsLineEndsAndAByteOrderMarkChangeNothing) {
    for (const Reader& reader : readers()) {
        if (reader.binary) continue;
        SampleBytes changed = bytesOf("\xEF\xBB\xBF");
        for (const std::byte byte : reader.sample) {
            if (byte == std::byte{'\n'}) changed.push_back(std::byte{'\r'});
            changed.push_back(byte);
        }
        EXPECT_TRUE(reader.is(changed)) << reader.name;
        EXPECT_EQ(refusalOf(reader, changed), "") << reader.name;
    }
}

TEST(Vendors, aFileThatIsCutOffIsRefusedInOneLine) {
    for (const Reader& reader : readers()) {
        ASSERT_EQ(refusalOf(reader, reader.sample), "") << reader.name;
        for (std::size_t size = 0; size < reader.sample.size(); ++size) {
            const SampleBytes cut(reader.sample.begin(),
                                  reader.sample.begin() + static_cast<std::ptrdiff_t>(size));
            const std::string refusal = refusalOf(reader, cut);
            // Texts may lose the end of their last number.
            const bool mayPass = !reader.binary && size + 30 > reader.sample.size();
            if (refusal.empty())
                EXPECT_TRUE(mayPass) << reader.name << " of " << size << " bytes";
            else
                expectOneLine(refusal);
        }
    }
}

TEST(Vendors, anotherFilesContentIsRefusedInOneLine) {
    std::vector<SampleBytes> swapped{bytesOf("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1"),
                                     bytesOf("# A desk.\nversion: 1\n"),
                                     bytesOf("PK\3\4"),
                                     bytesOf("PF\n2 2\n-1\n"),
                                     SampleBytes(4096),
                                     SampleBytes{}};
    for (const Reader& reader : readers()) {
        for (const SampleBytes& bytes : swapped) {
            EXPECT_FALSE(reader.is(bytes)) << reader.name;
            expectOneLine(refusalOf(reader, bytes));
        }
        for (const Reader& other : readers())
            if (other.is != reader.is) expectOneLine(refusalOf(reader, other.sample));
    }
}

TEST(Vendors, memoryFollowsTheFileAndNotItsCounts) {
    const std::vector<SampleBytes> huge{
        vioso({.width = 8192, .height = 4096, .dataBytes = 1U << 29}),
        sciss({.first = 2048, .second = 2048}),
        edited(kScalable, "VERTICES 4", "VERTICES 4194304"),
        edited(kDomeprojection, ";2;1\n", ";4194304;4194304\n"),
        edited(kPaulBourke, "3 2", "2048 2048")};
    for (const SampleBytes& bytes : huge)
        for (const Reader& reader : readers()) {
            if (!reader.is(bytes)) continue;
            const std::size_t before = test::bytesTaken;
            EXPECT_NE(refusalOf(reader, bytes), "") << reader.name;
            EXPECT_LT(test::bytesTaken - before, 1U << 20) << reader.name;
        }
}

TEST(Vendors, aMeshInManyLayersIsRefused) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
    for (int i = 0; i < 20; ++i) text += "f 1/1 2/2 3/3\n";
    EXPECT_THAT(refusalOf([&] { return readObjWarp(bytesOf(text), "a.obj", kSmall); }),
                HasSubstr("16 times over"));
}

TEST(Vendors, anImpossibleSizeIsRefused) {
    const SampleBytes uneven = sciss({.right = 0.5F});
    for (const glm::ivec2 size : {glm::ivec2(-1, 4), glm::ivec2(0, 4), glm::ivec2(1 << 30, 4)})
        EXPECT_THAT(refusalOf([&] {
                        return readSciss(uneven, "a.sgc", {size, {}, false});
                    }),
                    HasSubstr("give --size"));
}

}  // namespace
}  // namespace aquarama::formats
