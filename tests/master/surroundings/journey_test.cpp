// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include "common/base/units.h"
#include "common/place/place.h"
#include "master/surroundings/surroundings.h"
#include "tests/support/school_region.h"

namespace aquarama::surroundings {
namespace {

constexpr std::uint64_t kTenMinutes = 36000;  // ticks

TEST(Journey, theGoalMovesAsItsVelocitySaysAndNeverJumps) {
    for (std::uint32_t seed = 1; seed < 6; ++seed) {
        Goal before = journeyGoal(seed, {0});
        for (std::uint64_t tick = 1; tick < kTenMinutes; ++tick) {
            const Goal after = journeyGoal(seed, {tick});
            const glm::vec3 moved = (after.position - before.position) * 60.0F;
            const glm::vec3 mean =
                (after.velocityMetresPerSecond + before.velocityMetresPerSecond) * 0.5F;
            ASSERT_LT(place::lengthOf(moved - mean), 5e-3F) << "seed " << seed << " tick " << tick;
            before = after;
        }
    }
}

TEST(Journey, theGoalKeepsToTheWaterOfTheSchoolAndToSpeedsThatScadSwim) {
    const place::Region water = test::schoolRegion();
    for (std::uint32_t seed = 1; seed < 6; ++seed)
        for (std::uint64_t tick = 0; tick < kTenMinutes; tick += 7) {
            const Goal goal = journeyGoal(seed, {tick});
            const glm::vec3 from = glm::abs(goal.position - water.centre);
            ASSERT_TRUE(glm::all(glm::lessThan(from, water.halfExtent - 0.3F)))
                << "seed " << seed << " tick " << tick;
            // `fast` is 2.6 body lengths of 0.24 m a second.
            ASSERT_LT(place::lengthOf(goal.velocityMetresPerSecond), 0.68F) << seed << " " << tick;
        }
}

TEST(Journey, everyRoundPassesNearAndFarAndThroughBothWings) {
    for (std::uint32_t seed = 1; seed < 6; ++seed) {
        float nearest = 99, farthest = 0, leftmost = 0, rightmost = 0;
        for (std::uint64_t tick = 0; tick < 5400; ++tick) {
            const glm::vec3 from = journeyGoal(seed, {tick}).position - place::kEyePosition;
            const float azimuth = place::angleOf(from.x, -from.z) / kRadiansPerDegree<float>;
            nearest = std::min(nearest, place::lengthOf(from));
            farthest = std::max(farthest, place::lengthOf(from));
            leftmost = std::min(leftmost, azimuth);
            rightmost = std::max(rightmost, azimuth);
        }
        EXPECT_LT(nearest, 3.0F);
        EXPECT_GT(farthest, 7.0F);
        EXPECT_LT(leftmost, -40.0F);
        EXPECT_GT(rightmost, 40.0F);
    }
}

TEST(Mill, theBallRisesAndSinksByAMetreInTwentySecondsAndNeverJumps) {
    const place::Region water{{0, -7, -7}, {6, 4, 6}};
    float lowest = 0;
    float highest = -99;
    for (std::uint64_t tick = 0; tick < 1200; ++tick) {
        const Goal before = millGoal(1, water, 1, {tick});
        const Goal after = millGoal(1, water, 1, {tick + 1});
        const float rise = (after.position.y - before.position.y) * 60;
        ASSERT_NEAR(rise, before.velocityMetresPerSecond.y, 3e-3F) << tick;
        ASSERT_EQ(before.position.x, water.centre.x);
        ASSERT_EQ(std::abs(before.mill), 1);
        lowest = std::min(lowest, before.position.y);
        highest = std::max(highest, before.position.y);
    }
    EXPECT_NEAR(highest - lowest, 1, 0.01F);
    EXPECT_EQ(millGoal(1, water, 1, {0}).position, millGoal(1, water, 1, {1200}).position);
}

TEST(Mill, theBallGrowsWithTheCubeRootOfItsFishAndFlattensInShallowWater) {
    const place::Region deep{{0, -50, 0}, {50, 50, 50}};
    EXPECT_NEAR(millRadiusMetres(deep, 300, 0.24F), 0.925F, 0.005F);
    EXPECT_NEAR(millRadiusMetres(deep, 8 * 300, 0.24F), 2 * 0.925F, 0.01F);
    const place::Region shallow{{0, -5, 0}, {50, 4, 50}};
    const float broad = millRadiusMetres(shallow, 250'000, 0.24F);
    const float ball = millRadiusMetres(deep, 250'000, 0.24F);
    const float high = broad * millGoal(1, shallow, broad, {}).flatness;
    EXPECT_NEAR(high, 3, 0.01F);
    EXPECT_NEAR(broad * broad * high / (ball * ball * ball), 1, 0.01F) << "as much room";
}

}  // namespace
}  // namespace aquarama::surroundings
