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
    const auto point = screenPoint(rig.screen, rig.channels[0], {50, 50});
    ASSERT_TRUE(point);
    EXPECT_LT(distance(*point, {0, 0, -2}), 1e-12);
}

TEST(Warp, aPixelAtTangentTLightsTheAzimuthWhoseTangentIsT) {
    const config::Rig rig = axisRig();
    const auto point = screenPoint(rig.screen, rig.channels[0], {50 + 50 * 0.5, 50 - 50 * 0.25});
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
    const auto aimed = screenPoint(rig.screen, rig.channels[0], {50, 50});
    ASSERT_TRUE(aimed);
    EXPECT_LT(distance(*aimed, {-2 * std::sin(0.3), 2 * std::tan(0.1), -2 * std::cos(0.3)}), 1e-12);

    rig.channels[0].projector.yawPitchRollRadians = {0, 0, 0.2};
    const auto rolled = screenPoint(rig.screen, rig.channels[0], {60, 50});  // right of the middle
    ASSERT_TRUE(rolled);
    EXPECT_GT(rolled->y, 0);  // a counter-clockwise picture has its right side higher
}

TEST(Warp, aProjectorBehindTheScreenOrLookingAwayLightsNothing) {
    config::Rig rig = axisRig();
    rig.channels[0].projector.positionMetres = {0, 0, -5};
    EXPECT_FALSE(screenPoint(rig.screen, rig.channels[0], {50, 50}));
    rig.channels[0].projector.yawPitchRollRadians.x = 3.14159265;
    EXPECT_FALSE(screenPoint(rig.screen, rig.channels[0], {50, 50}));  // would light the outside
    EXPECT_EQ(blendWeight(rig, 0, {0, 0, -2}), 0);
}

TEST(Warp, unrolledPositionsRunFromTheTopLeftCorner) {
    const config::Screen screen = axisRig().screen;
    EXPECT_LT(glm::length(unrolled(screen, {0, 0, -2}) - glm::dvec2(0.5)), 1e-12);
    const glm::dvec3 corner = screenPointAt(screen, {0, 0});
    EXPECT_LT(distance(corner, {-2 * std::sin(0.75), 1.5, -2 * std::cos(0.75)}), 1e-12);
    Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec2 there(dice.between(0, 1), dice.between(0, 1));
        EXPECT_LT(glm::length(unrolled(screen, screenPointAt(screen, there)) - there), 1e-12);
    }
}

class WarpOfRig : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, WarpOfRig, testing::Values("theatre", "touring", "desk"));

TEST_P(WarpOfRig, projectingAndUnprojectingAnyPixelReturnsIt) {
    const config::Rig rig = shippedRig(GetParam());
    Dice dice;
    int lit = 0;
    for (const config::Channel& channel : rig.channels)
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 pixel(dice.between(0, channel.sizePixels.x),
                                   dice.between(0, channel.sizePixels.y));
            const auto point = screenPoint(rig.screen, channel, pixel);
            if (!point) continue;
            ++lit;
            EXPECT_NEAR(std::hypot(point->x, point->z), rig.screen.radiusMetres, 1e-12);
            const auto back = projectorPixel(channel, *point);
            ASSERT_TRUE(back);
            EXPECT_LT(glm::length(*back - pixel), 1e-9);
        }
    EXPECT_GT(lit, 5400);  // nine tenths of each picture fall on the screen
}

TEST_P(WarpOfRig, neighboursPutTheSameWorldPointOnTheSameScreenPoint) {
    const config::Rig rig = shippedRig(GetParam());
    const glm::dvec2 panorama(rig.panoramaPixels);
    Dice dice;
    int shared = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 point =
            screenPointAt(rig.screen, {dice.between(0, 1), dice.between(0, 1)});
        for (std::size_t a = 0; a + 1 < rig.channels.size(); ++a) {
            const auto left = projectorPixel(rig.channels[a], point);
            const auto right = projectorPixel(rig.channels[a + 1], point);
            if (!left || !right) continue;
            ++shared;
            const auto fromLeft = screenPoint(rig.screen, rig.channels[a], *left);
            const auto fromRight = screenPoint(rig.screen, rig.channels[a + 1], *right);
            ASSERT_TRUE(fromLeft && fromRight);
            const glm::dvec2 apart =
                unrolled(rig.screen, *fromLeft) - unrolled(rig.screen, *fromRight);
            EXPECT_LT(glm::length(apart * panorama), 1e-6);
        }
    }
    EXPECT_GT(shared, 500);
}

TEST_P(WarpOfRig, theMapSaysOfEachPixelWhatItsRaySays) {
    const config::Rig rig = shippedRig(GetParam());
    const WarpMap map = warpMap(rig, 1);
    const config::Channel& channel = rig.channels[1];
    ASSERT_EQ(map.sizePixels, channel.sizePixels);
    for (int y = 0; y < channel.sizePixels.y; y += 37)
        for (int x = 0; x < channel.sizePixels.x; x += 41) {
            const auto point = screenPoint(rig.screen, channel, {x + 0.5, y + 0.5});
            if (!point) continue;
            const int index = y * channel.sizePixels.x + x;
            const glm::vec4 entry = map.pointAndWeight[static_cast<std::size_t>(index)];
            EXPECT_LT(distance(glm::dvec3(entry), *point), 1e-6);
            EXPECT_NEAR(static_cast<double>(entry.w), blendWeight(rig, 1, *point), 1e-7);
        }
}

// The float map is what the nodes draw by: its rounding must not be seen where pictures overlap.
TEST_P(WarpOfRig, theMapIsExactToAHundredthOfAPanoramaPixel) {
    const config::Rig rig = shippedRig(GetParam());
    const glm::dvec2 panorama(rig.panoramaPixels);
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        const WarpMap map = warpMap(rig, c);
        for (std::size_t i = 0; i < map.pointAndWeight.size(); i += 101) {
            const glm::vec4 entry = map.pointAndWeight[i];
            if (entry.w <= 0) continue;
            const auto width = static_cast<std::size_t>(map.sizePixels.x);
            const std::size_t row = i / width;
            const glm::dvec2 pixel(static_cast<double>(i % width) + 0.5,
                                   static_cast<double>(row) + 0.5);
            const auto point = screenPoint(rig.screen, rig.channels[c], pixel);
            if (!point) continue;
            const glm::dvec2 off =
                unrolled(rig.screen, glm::dvec3(entry)) - unrolled(rig.screen, *point);
            ASSERT_LT(glm::length(off * panorama), 0.01);
        }
    }
}

}  // namespace
}  // namespace aquarama::wall
