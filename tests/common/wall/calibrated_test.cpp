// SPDX-License-Identifier: Apache-2.0
// Channels whose warp another program has found: what the desk's projectors light, told by a file
// in each of its ways, is the same wall again.
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/formats/mpcdi.h"
#include "rigs.h"

namespace aquarama::wall {
namespace {

using formats::Profile;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// Wide enough for all that the desk's wall shows.
formats::Frustum wideFrustum(double yaw) {
    return {.yaw = yaw * kDegree,
            .pitch = 2 * kDegree,
            .roll = -3 * kDegree,
            .left = -50 * kDegree,
            .right = 48 * kDegree,
            .down = -40 * kDegree,
            .up = 42 * kDegree};
}

// The place in a frustum's picture in which a point is seen from the origin.
glm::vec3 seenIn(const formats::Frustum& frustum, glm::dvec3 point) {
    const glm::dvec3 at = glm::transpose(formats::worldFromCamera(frustum)) * point;
    const double x = at.x / -at.z, y = at.y / -at.z;
    const double left = std::tan(frustum.left), right = std::tan(frustum.right);
    const double down = std::tan(frustum.down), up = std::tan(frustum.up);
    return {(x - left) / (right - left), (up - y) / (up - down), 0};
}

// The warps of a rig as a file says them.
formats::WallFile fileOf(const config::Rig& rig, Profile profile) {
    const Wall wall(rig);
    formats::WallFile file;
    file.profile = profile;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        formats::FileChannel& channel = file.channels.emplace_back();
        channel.name = rig.channels[i].name;
        channel.sizePixels = rig.channels[i].sizePixels;
        if (profile == Profile::View)
            channel.frustum = wideFrustum(40.0 * (static_cast<double>(i) - 1));
        formats::Warp warp{.size = channel.sizePixels, .samples = {}};
        for (const glm::vec4& pixel : wall.warp(i).pointAndWeight) {
            const glm::dvec3 point(pixel);
            if (pixel.w <= 0)
                warp.samples.emplace_back(kNothing);
            else if (profile == Profile::Screen)
                warp.samples.emplace_back(point);
            else if (profile == Profile::Content)
                warp.samples.emplace_back(wall.screen().unrolled(point), 0);
            else
                warp.samples.push_back(seenIn(*channel.frustum, point));
        }
        channel.warp = std::move(warp);
    }
    return file;
}

// The rig with the file in place of its projectors.
config::Rig calibrated(config::Rig rig, const std::vector<std::byte>& file) {
    rig.files["hall.mpcdi"] = std::make_shared<const std::vector<std::byte>>(file);
    for (config::Channel& channel : rig.channels)
        channel.wallFile = {"hall.mpcdi", channel.name, ""};
    return rig;
}

class WallFileOf : public testing::TestWithParam<Profile> {};
INSTANTIATE_TEST_SUITE_P(Profiles,
                         WallFileOf,
                         testing::Values(Profile::Content, Profile::View, Profile::Screen));

// Each pixel lights the point that it did, to two hundredths of a pixel.
TEST_P(WallFileOf, aRigIsTheSameWallAgain) {
    const config::Rig rig = shippedRig("desk");
    const Wall before(rig);
    for (const int version : {1, 2}) {
        const Wall after(calibrated(rig, encodeMpcdi(fileOf(rig, GetParam()), version)));
        for (std::size_t c = 0; c < rig.channels.size(); ++c) {
            const glm::ivec2 size = rig.channels[c].sizePixels;
            int compared = 0;
            for (int y = 3; y < size.y - 3; y += 7)
                for (int x = 3; x < size.x - 3; x += 7) {
                    const glm::dvec2 pixel(x + 0.5, y + 0.5);
                    const auto wanted = before.channel(c).pointOf(pixel, 0);
                    if (!wanted) continue;
                    const auto point = after.channel(c).pointOf(pixel, 0);
                    ASSERT_TRUE(point) << x << ' ' << y;
                    const auto back = before.channel(c).pixelOf(*point);
                    if (!back) continue;  // at the border, off by less than what is compared
                    ++compared;
                    ASSERT_LT(glm::distance(*back, pixel), 0.02) << x << ' ' << y;
                }
            EXPECT_GT(compared, 2000);
        }
    }
}

TEST_P(WallFileOf, aRigLeadsPointsBackToTheirPixels) {
    const config::Rig rig = shippedRig("desk");
    const Wall wall(calibrated(rig, encodeMpcdi(fileOf(rig, GetParam()), 2)));
    Dice dice;
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        int found = 0;
        for (int i = 0; i < 500; ++i) {
            const glm::dvec2 size(rig.channels[c].sizePixels);
            const glm::dvec2 pixel(dice.between(3, size.x - 3), dice.between(3, size.y - 3));
            const auto point = wall.channel(c).pointOf(pixel, 0);
            if (!point) continue;
            const auto back = wall.channel(c).pixelOf(*point);
            if (!back) continue;
            ++found;
            EXPECT_LT(glm::distance(*back, pixel), 0.05);
        }
        EXPECT_GT(found, 400);
    }
}

// Without a blend of its own a channel shares light as projectors do.
TEST(WallFiles, shareLightWhereTheyHaveNoBlend) {
    const config::Rig rig = shippedRig("desk");
    const Wall before(rig);
    const Wall after(calibrated(rig, encodeMpcdi(fileOf(rig, Profile::Screen), 2)));
    for (double u = 0.05; u < 1; u += 0.01) {
        const glm::dvec3 point = before.screen().at({u, 0.4}).value();
        for (std::size_t c = 0; c < rig.channels.size(); ++c)
            EXPECT_NEAR(after.weight(c, point), before.weight(c, point), 2e-3) << u;
    }
}

TEST(WallFiles, aGreyBlendIsTheWeight) {
    const config::Rig rig = shippedRig("desk");
    formats::WallFile file = fileOf(rig, Profile::Screen);
    for (formats::FileChannel& channel : file.channels)
        channel.blend = formats::Mask{.size = {1, 1}, .bits = 8, .gamma = 2.2, .codes = {128}};
    const WarpMap warp = Wall(calibrated(rig, encodeMpcdi(file, 2))).warp(0);
    EXPECT_TRUE(warp.blend.empty());
    for (const glm::vec4& pixel : warp.pointAndWeight) {
        if (pixel.w == 0) continue;
        ASSERT_NEAR(pixel.w, std::pow(128.0F / 255, 2.2F), 1e-5F);
    }
}

TEST(WallFiles, aColouredBlendAndABlackLevelAreLight) {
    const config::Rig rig = shippedRig("desk");
    formats::WallFile file = fileOf(rig, Profile::Screen);
    for (formats::FileChannel& channel : file.channels) {
        channel.blend = formats::Mask{
            .size = {1, 1}, .components = 3, .bits = 8, .gamma = 2.2, .codes = {255, 128, 0}};
        channel.black = formats::Mask{
            .size = {1, 1}, .components = 3, .bits = 16, .gamma = 1, .codes = {0, 655, 6554}};
    }
    const WarpMap warp = Wall(calibrated(rig, encodeMpcdi(file, 2))).warp(0);
    ASSERT_EQ(warp.blend.size(), warp.pointAndWeight.size());
    ASSERT_EQ(warp.black.size(), warp.pointAndWeight.size());
    EXPECT_NEAR(warp.blend[1000].y, std::pow(128.0F / 255, 2.2F), 1e-5F);
    EXPECT_NEAR(warp.black[1000].z, 6554.0F / 65535, 1e-4F);
    for (const glm::vec4& pixel : warp.pointAndWeight)  // in place of the weight
        EXPECT_TRUE(pixel.w == 0 || pixel.w == 1);
}

// A flat wall five metres ahead of a projector whose lens and whose warp are both known.
constexpr double kThrowMetres = 5;
const glm::dvec3 kProjector(0.2, -0.1, 1);
glm::dvec2 throughLens(glm::dvec2 place) {
    const glm::dvec2 off = place - 0.5;
    return 0.5 + off * (1 - 0.2 * glm::dot(off, off));
}
glm::dvec2 warped(glm::dvec2 place) {
    return place * glm::dvec2(0.8, 0.9) + 0.05;
}

formats::WallFile shaderLamp(glm::ivec2 sizePixels) {
    formats::WallFile file;
    file.profile = Profile::Projector;
    formats::FileChannel& channel = file.channels.emplace_back();
    channel.name = "lamp";
    channel.sizePixels = sizePixels;
    channel.frustum = {.left = -0.3, .right = 0.35, .down = -0.25, .up = 0.2};
    channel.coordinateFrame = formats::CoordinateFrame{kProjector};
    channel.warp = formats::Warp{.size = sizePixels, .samples = {}};
    channel.distortion = channel.warp;
    for (int y = 0; y < sizePixels.y; ++y)
        for (int x = 0; x < sizePixels.x; ++x) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(sizePixels);
            channel.distortion->samples.emplace_back(throughLens(place), 0);
            channel.warp->samples.emplace_back(warped(place), 0);
        }
    return file;
}

// The pixel's light goes through the lens first; what the warp says is of the picture behind it.
TEST(WallFiles, aShaderLampThrowsThroughItsDistortionMap) {
    config::Rig rig = shippedRig("flat_3");
    rig.screen.distanceMetres = kThrowMetres - kProjector.z;
    rig.screen.heightMetres = 4;
    rig.channels.resize(1);
    const glm::ivec2 size = rig.channels[0].sizePixels;
    const formats::WallFile file = shaderLamp(size);
    const Wall wall(calibrated(rig, encodeMpcdi(file, 2)));
    const formats::Frustum& frustum = *file.channels[0].frustum;
    const glm::dvec2 low(std::tan(frustum.left), std::tan(frustum.up));
    const glm::dvec2 high(std::tan(frustum.right), std::tan(frustum.down));
    for (int y = 0; y < size.y; y += 11)
        for (int x = 0; x < size.x; x += 11) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const auto point = wall.channel(0).pointOf(pixel, 0);
            ASSERT_TRUE(point);
            const glm::dvec2 seen = warped(throughLens(pixel / glm::dvec2(size)));
            const glm::dvec2 there = kThrowMetres * glm::mix(low, high, seen);
            EXPECT_LT(glm::distance(*point, kProjector + glm::dvec3(there, -kThrowMetres)), 1e-5)
                << x << ' ' << y;
            const auto back = wall.channel(0).pixelOf(*point);
            ASSERT_TRUE(back);
            EXPECT_LT(glm::distance(*back, pixel), 0.01);
        }
}

TEST(WallFiles, aColourIsOfItsChannelAlone) {
    const config::Rig rig = shippedRig("desk");
    formats::WallFile file = fileOf(rig, Profile::Screen);
    file.channels[1].colour = {.mix = glm::mat3(0.75F),
                               .response = {{{0, 1}, {0, 0.3F, 1}, {0, 1}}}};
    const Wall wall(calibrated(rig, encodeMpcdi(file, 1)));
    ASSERT_NE(wall.channel(1).colour(), nullptr);
    EXPECT_EQ(wall.channel(1).colour()->mix, glm::mat3(0.75F));
    EXPECT_EQ(wall.channel(1).colour()->response, file.channels[1].colour->response);
    EXPECT_EQ(wall.channel(0).colour(), nullptr);
    EXPECT_EQ(Wall(rig).channel(1).colour(), nullptr);
}

TEST(WallFiles, aRegionThatIsNotThereIsNamed) {
    config::Rig rig = shippedRig("desk");
    rig = calibrated(rig, encodeMpcdi(fileOf(rig, Profile::Screen), 2));
    rig.channels[1].wallFile->region = "centre";
    try {
        const Wall wall(rig);
        FAIL() << "it was taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("hall.mpcdi"));
        EXPECT_THAT(error.what(), testing::HasSubstr("centre"));
        EXPECT_THAT(error.what(), testing::HasSubstr("left, middle, right"));
    }
}

TEST(WallFiles, aFileThatIsCutOffIsRefusedByItsName) {
    config::Rig rig = shippedRig("desk");
    std::vector<std::byte> file = encodeMpcdi(fileOf(rig, Profile::Screen), 2);
    file.resize(file.size() / 2);
    try {
        const Wall wall(calibrated(rig, file));
        FAIL() << "it was taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("hall.mpcdi"));
    }
}

}  // namespace
}  // namespace aquarama::wall
