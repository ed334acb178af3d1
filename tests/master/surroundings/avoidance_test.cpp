// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/avoidance.h"

#include <gtest/gtest.h>

#include "common/place/place.h"

namespace aquarama::surroundings {
namespace {

const glm::vec3 kForward{1, 0, 0};

place::Obstacles openWater() {
    return {{3}, {{0, -4, -5}, {6, 3, 4}}, {}};
}

TEST(Avoidance, openWaterDoesNotPush) {
    EXPECT_EQ(avoidance(openWater(), {0, -4, -5}, kForward, 1), glm::vec3(0));
}

TEST(Avoidance, aBorderIsFeltBeforeItIsReachedAndTheMoreTheNearer) {
    const place::Obstacles water = openWater();
    EXPECT_EQ(avoidance(water, {3.5F, -4, -5}, kForward, 1), glm::vec3(0));
    const float early = avoidance(water, {4.5F, -4, -5}, kForward, 1).x;
    const float late = avoidance(water, {5.4F, -4, -5}, kForward, 1).x;
    EXPECT_LT(early, 0);
    EXPECT_LT(late, 2 * early);
    EXPECT_EQ(avoidance(water, {4.5F, -4, -5}, -kForward, 1), glm::vec3(0)) << "swims away from it";
}

TEST(Avoidance, theSandPushesUpAndTheSurfacePushesDown) {
    place::Obstacles water = openWater();
    water.water.halfExtent.y = 20;  // so that only the place itself is felt
    const float floor = place::floorHeight(water.place, {0, -5});
    EXPECT_GT(avoidance(water, {0, floor + 0.4F, -5}, kForward, 0.1F).y, 0.5F);
    EXPECT_LT(avoidance(water, {0, -0.5F, -5}, kForward, 0.1F).y, -0.5F);
    EXPECT_EQ(avoidance(water, {0, floor + 2.0F, -5}, kForward, 0.1F).y, 0);
}

TEST(Avoidance, aRockOnThePathPushesToTheSideOnWhichThePathPassesIt) {
    place::Obstacles water = openWater();
    water.rocks = {{{1.5F, -4, -5}, 0.5F, 1}};
    EXPECT_GT(avoidance(water, {0, -4, -4.7F}, kForward, 1.5F).z, 0.1F);
    EXPECT_LT(avoidance(water, {0, -4, -5.3F}, kForward, 1.5F).z, -0.1F);
    EXPECT_EQ(avoidance(water, {0, -4, -4.7F}, -kForward, 1.5F), glm::vec3(0));
}

TEST(Avoidance, aKelpPlantPushesAsideBelowItsTopAndNotAbove) {
    place::Obstacles water = openWater();
    water.stems = {{{1.0F, -5.0F}, -3.0F}};
    EXPECT_GT(avoidance(water, {0, -4, -4.8F}, kForward, 1.5F).z, 0.05F);
    EXPECT_LT(avoidance(water, {0, -4, -5.2F}, kForward, 1.5F).z, -0.05F);
    EXPECT_EQ(avoidance(water, {0, -4, -4.8F}, kForward, 1.5F).y, 0) << "it goes up to the top";
    EXPECT_EQ(avoidance(water, {0, -2.8F, -4.8F}, kForward, 1.5F), glm::vec3(0));
}

}  // namespace
}  // namespace aquarama::surroundings
