// SPDX-License-Identifier: Apache-2.0
// From projector pixel to screen point and back, against closed forms and against itself.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rigs.h"

namespace aquarama::wall {
namespace {

double distance(glm::dvec3 a, glm::dvec3 b) {
    return glm::length(a - b);
}

TEST(Warp, aProjectorOnTheAxisHitsTheMiddle) {
    const config::Rig rig = axisRig();
    const auto point = Wall(rig).channel(0).pointOf({50, 50}, 0);
    ASSERT_TRUE(point);
    EXPECT_LT(distance(*point, {0, 0, -2}), 1e-12);
}

TEST(Warp, aPixelAtTangentTLightsTheAzimuthWhoseTangentIsT) {
    const config::Rig rig = axisRig();
    const auto point = Wall(rig).channel(0).pointOf({50 + 50 * 0.5, 50 - 50 * 0.25}, 0);
    ASSERT_TRUE(point);
    const double azimuth = std::atan(0.5);  // the projector is on the axis
    EXPECT_LT(
        distance(*point,
                 {2 * std::sin(azimuth), 0.25 * 2 * std::cos(azimuth), -2 * std::cos(azimuth)}),
        1e-12);
}

TEST(Warp, yawTurnsLeftPitchTurnsUpRollTurnsCounterClockwise) {
    config::Rig rig = axisRig();
    rig.channels[0].projector.yawPitchRollRadians = {0.3, 0.1, 0};
    const auto aimed = Wall(rig).channel(0).pointOf({50, 50}, 0);
    ASSERT_TRUE(aimed);
    EXPECT_LT(distance(*aimed, {-2 * std::sin(0.3), 2 * std::tan(0.1), -2 * std::cos(0.3)}), 1e-12);

    rig.channels[0].projector.yawPitchRollRadians = {0, 0, 0.2};
    const auto rolled = Wall(rig).channel(0).pointOf({60, 50}, 0);  // right of the middle
    ASSERT_TRUE(rolled);
    EXPECT_GT(rolled->y, 0);  // a counter-clockwise picture has its right side higher
}

TEST(Warp, aProjectorBehindTheScreenOrLookingAwayLightsNothing) {
    config::Rig rig = axisRig();
    rig.channels[0].projector.positionMetres = {0, 0, -5};
    EXPECT_FALSE(Wall(rig).channel(0).pointOf({50, 50}, 0));
    rig.channels[0].projector.yawPitchRollRadians.x = 3.14159265;
    EXPECT_FALSE(Wall(rig).channel(0).pointOf({50, 50}, 0));  // would light the outside
    EXPECT_EQ(Wall(rig).weight(0, {0, 0, -2}), 0);
}

TEST(Warp, unrolledPositionsRunFromTheTopLeftCorner) {
    const auto screen = makeSurface(axisRig());
    EXPECT_LT(glm::length(screen->unrolled({0, 0, -2}) - glm::dvec2(0.5)), 1e-12);
    const glm::dvec3 corner = screen->at({0, 0}).value();
    EXPECT_LT(distance(corner, {-2 * std::sin(0.75), 1.5, -2 * std::cos(0.75)}), 1e-12);
    Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec2 there(dice.between(0, 1), dice.between(0, 1));
        EXPECT_LT(glm::length(screen->unrolled(screen->at(there).value()) - there), 1e-12);
    }
}

class WarpOfRig : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, WarpOfRig, testing::Values("theatre", "touring", "desk"));

TEST_P(WarpOfRig, projectingAndUnprojectingAnyPixelReturnsIt) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    Dice dice;
    int lit = 0;
    for (std::size_t c = 0; c < rig.channels.size(); ++c)
        for (int i = 0; i < 2000; ++i) {
            const glm::ivec2 size = rig.channels[c].sizePixels;
            const glm::dvec2 pixel(dice.between(0, size.x), dice.between(0, size.y));
            const auto point = wall.channel(c).pointOf(pixel, 0);
            if (!point) continue;
            ++lit;
            EXPECT_NEAR(std::hypot(point->x, point->z), rig.screen.radiusMetres, 1e-12);
            const auto back = wall.channel(c).pixelOf(*point);
            ASSERT_TRUE(back);
            EXPECT_LT(glm::length(*back - pixel), 1e-9);
        }
    EXPECT_GT(lit, 5400);  // nine tenths of each picture fall on the screen
}

TEST_P(WarpOfRig, neighboursPutTheSameWorldPointOnTheSameScreenPoint) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    const glm::dvec2 panorama(rig.panoramaPixels);
    Dice dice;
    int shared = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 point = wall.screen().at({dice.between(0, 1), dice.between(0, 1)}).value();
        for (std::size_t a = 0; a + 1 < rig.channels.size(); ++a) {
            const auto left = wall.channel(a).pixelOf(point);
            const auto right = wall.channel(a + 1).pixelOf(point);
            if (!left || !right) continue;
            ++shared;
            const auto fromLeft = wall.channel(a).pointOf(*left, 0);
            const auto fromRight = wall.channel(a + 1).pointOf(*right, 0);
            ASSERT_TRUE(fromLeft && fromRight);
            const glm::dvec2 apart =
                wall.screen().unrolled(*fromLeft) - wall.screen().unrolled(*fromRight);
            EXPECT_LT(glm::length(apart * panorama), 1e-6);
        }
    }
    EXPECT_GT(shared, 500);
}

TEST_P(WarpOfRig, theMapSaysOfEachPixelWhatItsRaySays) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    const WarpMap map = wall.warp(1);
    const config::Channel& channel = rig.channels[1];
    ASSERT_EQ(map.sizePixels, channel.sizePixels);
    for (int y = 0; y < channel.sizePixels.y; y += 37)
        for (int x = 0; x < channel.sizePixels.x; x += 41) {
            const auto point = wall.channel(1).pointOf({x + 0.5, y + 0.5}, 0);
            if (!point) continue;
            const int index = y * channel.sizePixels.x + x;
            const glm::vec4 entry = map.pointAndWeight[static_cast<std::size_t>(index)];
            EXPECT_LT(distance(glm::dvec3(entry), *point), 1e-6);
            EXPECT_NEAR(static_cast<double>(entry.w), wall.weight(1, *point), 1e-7);
        }
}

// The float map is what the nodes draw by: its rounding must not be seen where pictures overlap.
TEST_P(WarpOfRig, theMapIsExactToAHundredthOfAPanoramaPixel) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    const glm::dvec2 panorama(rig.panoramaPixels);
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        const WarpMap map = wall.warp(c);
        for (std::size_t i = 0; i < map.pointAndWeight.size(); i += 101) {
            const glm::vec4 entry = map.pointAndWeight[i];
            if (entry.w <= 0) continue;
            const auto width = static_cast<std::size_t>(map.sizePixels.x);
            const std::size_t row = i / width;
            const glm::dvec2 pixel(static_cast<double>(i % width) + 0.5,
                                   static_cast<double>(row) + 0.5);
            const auto point = wall.channel(c).pointOf(pixel, 0);
            if (!point) continue;
            const glm::dvec2 off =
                wall.screen().unrolled(glm::dvec3(entry)) - wall.screen().unrolled(*point);
            ASSERT_LT(glm::length(off * panorama), 0.01);
        }
    }
}

}  // namespace
}  // namespace aquarama::wall
