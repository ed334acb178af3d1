// SPDX-License-Identifier: Apache-2.0
// Angles and axes, samples between samples, meshes, and which reader a file gets.
#include "common/formats/wall_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/units.h"
#include "tests/common/formats/sample_walls.h"

namespace aquarama::formats {
namespace {

const glm::dvec3 kForward(0, 0, -1), kUp(0, 1, 0), kRight(1, 0, 0);

void expectNear(glm::dvec3 a, glm::dvec3 b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

TEST(Angles, yawTurnsRight) {
    const glm::dmat3 turn = worldFromCamera({.yaw = 30 * kDegree});
    expectNear(turn * kForward, {0.5, 0, -std::sqrt(0.75)});
    expectNear(turn * kUp, kUp);
}

TEST(Angles, pitchTiltsUp) {
    const glm::dmat3 turn = worldFromCamera({.pitch = 30 * kDegree});
    expectNear(turn * kForward, {0, 0.5, -std::sqrt(0.75)});
    expectNear(turn * kRight, kRight);
}

TEST(Angles, rollLowersTheRightWing) {
    const glm::dmat3 turn = worldFromCamera({.roll = 30 * kDegree});
    expectNear(turn * kForward, kForward);
    expectNear(turn * kRight, {std::sqrt(0.75), -0.5, 0});
}

// Roll is about the camera's own axis, pitch about the horizontal axis that yaw has turned.
TEST(Angles, yawIsOutermostAndRollInnermost) {
    const double a = 0.3, b = 0.7, c = 1.1;
    const glm::dmat3 turn = worldFromCamera({.yaw = a, .pitch = b, .roll = c});
    expectNear(turn * kForward,
               {std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b)});
    const glm::dvec3 levelRight(std::cos(a), 0, std::sin(a));
    const glm::dvec3 up(-std::sin(a) * std::sin(b), std::cos(b), std::cos(a) * std::sin(b));
    expectNear(turn * kRight, std::cos(c) * levelRight - std::sin(c) * up);
}

TEST(Frame, positionsBecomeCanonicalFromZUpAndFromOpenGl) {
    CoordinateFrame zUp{{1, 2, 3}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(zUp.canonicalPosition(), glm::dvec3(1, 3, -2));
    EXPECT_EQ((CoordinateFrame{{1, 2, 3}}.canonicalPosition()), glm::dvec3(1, 2, 3));
}

// Linear in the place: x + 10 y.
Warp ramp(Sampling sampling) {
    Warp warp{.size = {5, 3}, .sampling = sampling, .samples = {}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) {
            const glm::dvec2 place = sampling == Sampling::Centres
                                         ? glm::dvec2((x + 0.5) / 5, (y + 0.5) / 3)
                                         : glm::dvec2(x / 4.0, y / 2.0);
            warp.samples.emplace_back(place.x, place.y, place.x + 10 * place.y);
        }
    return warp;
}

TEST(WarpAt, whatIsLinearStaysSoBetweenAndBeyondSamples) {
    for (const Sampling sampling : {Sampling::Centres, Sampling::Nodes})
        for (const glm::dvec2 place : {glm::dvec2(0, 0),
                                       glm::dvec2(1, 1),
                                       glm::dvec2(0.37, 0.81),
                                       glm::dvec2(-0.1, 1.2),
                                       glm::dvec2(0.5, 0.5)}) {
            const glm::vec3 found = warpAt(ramp(sampling), place);
            EXPECT_NEAR(found.x, place.x, 1e-6);
            EXPECT_NEAR(found.y, place.y, 1e-6);
            EXPECT_NEAR(found.z, place.x + 10 * place.y, 1e-5);
        }
}

TEST(WarpAt, onlySamplesThatMatterMakeItUnlit) {
    Warp warp = ramp(Sampling::Nodes);
    warp.samples[1] = glm::vec3(test::kUnlit);  // at (0.25, 0)
    EXPECT_TRUE(std::isnan(warpAt(warp, {0.2, 0.1}).x));
    EXPECT_EQ(warpAt(warp, {0, 0}).x, 0);
    EXPECT_EQ(warpAt(warp, {0.5, 0.25}).x, 0.5F);
    EXPECT_TRUE(std::isnan(warpAt(warp, {std::nan(""), 0}).x));
}

TEST(WarpAt, aSingleSampleIsEverywhere) {
    const Warp warp{.size = {1, 1}, .samples = {{0.2F, 0.3F, 0}}};
    EXPECT_EQ(warpAt(warp, {0.9, 0.1}), glm::vec3(0.2F, 0.3F, 0));
}

TEST(WarpAt, nodesBecomeCentresOfAFinerGrid) {
    Warp nodes = ramp(Sampling::Nodes);
    nodes.stored = Stored::Offsets;
    const Warp fine = resampled(nodes, {20, 10});
    EXPECT_EQ(fine.sampling, Sampling::Centres);
    EXPECT_EQ(fine.stored, Stored::Places);
    EXPECT_NEAR(fine.samples[20 * 7 + 3].x, 3.5 / 20, 1e-6);
    EXPECT_NEAR(fine.samples[20 * 7 + 3].y, 7.5 / 10, 1e-6);
}

Mask maskOf(int components, int bits) {
    Mask mask{.size = {8, 8}, .components = components, .bits = bits, .gamma = 2.2, .codes = {}};
    const int step = bits == 16 ? 331 : 1;
    for (int i = 0; i < 64 * components; ++i)
        mask.codes.push_back(static_cast<std::uint16_t>(i * step));
    return mask;
}

TEST(MaskLight, isTheLightOfItsCodes) {
    for (const int components : {1, 3})
        for (const int bits : {8, 16}) {
            const Mask mask = maskOf(components, bits);
            const MaskLight light(mask);
            for (double y = -0.1; y < 1.1; y += 0.03)
                for (double x = -0.1; x < 1.1; x += 0.03)
                    ASSERT_EQ(light.at({x, y}), lightAt(mask, {x, y})) << x << ' ' << y;
        }
}

// Two triangles over the left half of the picture, which show a whole one.
WarpMesh halfPicture() {
    WarpMesh mesh;
    mesh.vertices = {{{0, 0}, {0, 0, 1}, 0},
                     {{0.5, 0}, {1, 0, 1}, 1},
                     {{0.5, 1}, {1, 1, 1}, 1},
                     {{0, 1}, {0, 1, 1}, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

TEST(Rasterised, samplesAreLinearWithinTrianglesAndNothingBeside) {
    Mask light;
    const Warp warp = rasterised(halfPicture(), {16, 8}, &light);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const glm::vec3 sample = warp.samples[static_cast<std::size_t>(16 * y + x)];
            const std::uint16_t code = light.codes[static_cast<std::size_t>(16 * y + x)];
            if (x >= 8) {
                EXPECT_TRUE(std::isnan(sample.x));
                EXPECT_EQ(code, 0);
                continue;
            }
            EXPECT_NEAR(sample.x, (x + 0.5) / 8, 1e-6);
            EXPECT_NEAR(sample.y, (y + 0.5) / 8, 1e-6);
            EXPECT_NEAR(code, (x + 0.5) / 8 * 65535, 1);
        }
}

TEST(Rasterised, theLaterTriangleWinsAndOneWithoutAreaIsNothing) {
    WarpMesh mesh = halfPicture();
    for (const WarpMesh::Vertex& vertex : halfPicture().vertices) {
        mesh.vertices.push_back(vertex);
        mesh.vertices.back().target.z = 2;
    }
    mesh.triangles.push_back({4, 5, 6});
    mesh.triangles.push_back({4, 6, 7});
    mesh.triangles.push_back({0, 1, 1});
    const Warp warp = rasterised(mesh, {16, 8});
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(warp.samples[static_cast<std::size_t>(x)].z, 2, 1e-6);
}

TEST(Rasterised, farAndUnknownPlacesAreBounded) {
    WarpMesh mesh = halfPicture();
    mesh.vertices[1].place = {1e300, 0};
    mesh.vertices[3].place.y = std::nan("");
    EXPECT_EQ(rasterised(mesh, {4, 4}).samples.size(), 16U);
}

TEST(Response, isUndoneByItsCodes) {
    const std::vector<float> response{0, 0.1F, 0.1F, 0.6F, 1};
    EXPECT_EQ(codeFor(response, 0), 0);
    EXPECT_EQ(codeFor(response, -1), 0);
    EXPECT_EQ(codeFor(response, 1), 1);
    EXPECT_EQ(codeFor(response, 2), 1);
    EXPECT_NEAR(codeFor(response, 0.8), 0.875, 1e-7);
    for (double light = 0; light <= 1; light += 1.0 / 512)
        EXPECT_NEAR(lightFor(response, codeFor(response, light)), light, 1e-12);
}

// A projector that gives no light for its first codes, and all of it before its last.
TEST(Response, isGivenTheLeastCodeWhereItIsFlat) {
    const std::vector<float> response{0, 0, 0.5F, 1, 1};
    EXPECT_EQ(codeFor(response, 0), 0);
    EXPECT_GT(codeFor(response, 1e-9), 0.25);
    EXPECT_EQ(codeFor(response, 1), 0.75);
    EXPECT_EQ(codeFor(std::vector<float>{0, 0.5F, 0.5F, 1}, 0.5), 1.0 / 3);
}

TEST(WallFiles, aFileIsKnownByItsContentAndNotByItsName) {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "aquarama-any-name.bin";
    writeMpcdi(path, test::sampleWall(Profile::Content), 1);
    EXPECT_EQ(readWallFile(path).channels.size(), 2U);
    std::ofstream(path) << "nothing of the kind";
    const std::string complaint = test::complaintOf([&] { (void)readWallFile(path); });
    EXPECT_THAT(complaint, testing::HasSubstr("aquarama-any-name.bin: is of no known format"));
    std::filesystem::remove(path);
    EXPECT_THAT(test::complaintOf([&] { (void)readWallFile(path); }),
                testing::HasSubstr("aquarama-any-name.bin: cannot be read"));
}

}  // namespace
}  // namespace aquarama::formats
