// SPDX-License-Identifier: Apache-2.0
// The current turns with the tide, its way is the integral of its velocity, and boulders bend it.
#include "common/place/current.h"

#include <cmath>

#include <gtest/gtest.h>

namespace aquarama::place {
namespace {

constexpr config::SceneCurrent kCurrent{.tideMetresPerSecond = 0.05,
                                        .tideSeconds = 620,
                                        .surgeMetresPerSecond = 0.02,
                                        .surgeSeconds = 7};
constexpr Region kFlowingWater{{0, -5, -5}, {6, 3, 4}};
const Rock kRock{.centre = {1, -7, -5}, .radiusMetres = 1, .seed = 1};

TEST(Current, theTideTurnsTwiceInItsPeriodAndTheSurgeInIts) {
    const config::SceneCurrent tide{.tideMetresPerSecond = 0.05, .tideSeconds = 600};
    EXPECT_NEAR(openCurrent(tide, 0).x, 0, 1e-6F);
    EXPECT_NEAR(openCurrent(tide, 150 * 60).x, 0.05F, 1e-6F);
    EXPECT_NEAR(openCurrent(tide, 300 * 60).x, 0, 1e-6F);
    EXPECT_NEAR(openCurrent(tide, 450 * 60).x, -0.05F, 1e-6F);
    EXPECT_EQ(openCurrent(tide, 150 * 60), openCurrent(tide, 750 * 60));
    EXPECT_EQ(openCurrent(tide, -450 * 60), openCurrent(tide, 150 * 60)) << "before tick 0 too";
    const config::SceneCurrent surge{.surgeMetresPerSecond = 0.02, .surgeSeconds = 8};
    EXPECT_NEAR(lengthOf(openCurrent(surge, 2 * 60)), 0.02F, 1e-6F);
    EXPECT_NEAR(dot(openCurrent(surge, 6 * 60), kSurgeCourse), -0.02F, 1e-6F);
    EXPECT_EQ(openCurrent({}, 1234), glm::vec3(0));
}

TEST(Current, itsWayIsTheIntegralOfItsVelocityAndComesBack) {
    glm::dvec3 sum{};
    for (std::int64_t tick = 0; tick < 620 * 60; ++tick) {
        const glm::vec3 way = openDrift(kCurrent, tick);
        ASSERT_LT(lengthOf(way - glm::vec3(sum)), 0.01F) << "tick " << tick;
        sum += glm::dvec3(openCurrent(kCurrent, tick)) / 60.0;
    }
    const config::SceneCurrent tide{.tideMetresPerSecond = 0.05, .tideSeconds = 620};
    EXPECT_NEAR(openDrift(tide, 310 * 60).x, 0.05F * 620 / 3, 1e-4F) << "furthest at half time";
    EXPECT_NEAR(openDrift(tide, 620 * 60).x, 0, 1e-5F);
}

TEST(Current, isStrongerOverACrownAndWeakerInTheLee) {
    const Current current(kCurrent, {&kRock, 1}, kFlowingWater);
    for (const float way : {1.0F, -1.0F}) {
        const glm::vec3 open{0.05F * way, 0, 0};
        const auto factor = [&](glm::vec3 place) { return current.at(place, open).x / open.x; };
        EXPECT_NEAR(factor({-5, -5, -2}), 1, 1e-5F) << "far off";
        EXPECT_GT(factor({1, -5.9F, -5}), 1.3F) << "over the crown";
        EXPECT_LE(factor({1, -5.9F, -5}), kOverCrown);
        EXPECT_LT(factor({1 + 1.2F * way, -7, -5}), 0.6F) << "in the lee";
        EXPECT_GE(factor({1 + 1.2F * way, -7, -5}), kInLee);
        EXPECT_NEAR(factor({1 - 1.6F * way, -7, -5}), 1, 0.05F) << "before the boulder";
    }
}

TEST(Current, isContinuousAndBoundedInAllTheWaterAndBeyond) {
    const Current current(kCurrent, {&kRock, 1}, kFlowingWater);
    const glm::vec3 open{0.05F, 0, 0.01F};
    constexpr float kStep = 0.01F;
    for (float x = -8; x < 8; x += 0.17F)
        for (float y = -9; y < -1; y += 0.23F) {
            const glm::vec3 here = current.at({x, y, -5.2F}, open);
            ASSERT_LE(lengthOf(here), 1.001F * kOverCrown * lengthOf(open));
            ASSERT_GE(lengthOf(here), 0.999F * kInLee * lengthOf(open));
            ASSERT_LT(lengthOf(current.at({x + kStep, y, -5.2F}, open) - here), 0.002F);
            ASSERT_LT(lengthOf(current.at({x, y + kStep, -5.2F}, open) - here), 0.002F);
        }
}

TEST(Current, stillWaterIsStill) {
    EXPECT_TRUE(Current().isStill());
    EXPECT_TRUE(Current({}, {&kRock, 1}, kFlowingWater).isStill());
    EXPECT_EQ(Current().at({1, -5, -5}, {}), glm::vec3(0));
}

}  // namespace
}  // namespace aquarama::place
