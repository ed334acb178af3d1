// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/journey.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include "common/place/angle.h"
#include "common/place/place.h"

namespace aquarama {
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
            ASSERT_LT(lengthOf(moved - mean), 5e-3F) << "seed " << seed << " tick " << tick;
            before = after;
        }
    }
}

TEST(Journey, theGoalKeepsToTheWaterOfTheSchoolAndToSpeedsThatScadSwim) {
    const Region water = schoolRegion();
    for (std::uint32_t seed = 1; seed < 6; ++seed)
        for (std::uint64_t tick = 0; tick < kTenMinutes; tick += 7) {
            const Goal goal = journeyGoal(seed, {tick});
            const glm::vec3 from = glm::abs(goal.position - water.centre);
            ASSERT_TRUE(glm::all(glm::lessThan(from, water.halfExtent - 0.3F)))
                << "seed " << seed << " tick " << tick;
            // `fast` is 2.6 body lengths of 0.24 m a second.
            ASSERT_LT(lengthOf(goal.velocityMetresPerSecond), 0.68F) << seed << " " << tick;
        }
}

TEST(Journey, everyRoundPassesNearAndFarAndThroughBothWings) {
    for (std::uint32_t seed = 1; seed < 6; ++seed) {
        float nearest = 99, farthest = 0, leftmost = 0, rightmost = 0;
        for (std::uint64_t tick = 0; tick < 5400; ++tick) {
            const glm::vec3 from = journeyGoal(seed, {tick}).position - kEyePosition;
            const float azimuth = angleOf(from.x, -from.z) / kRadiansPerDegree;
            nearest = std::min(nearest, lengthOf(from));
            farthest = std::max(farthest, lengthOf(from));
            leftmost = std::min(leftmost, azimuth);
            rightmost = std::max(rightmost, azimuth);
        }
        EXPECT_LT(nearest, 3.0F);
        EXPECT_GT(farthest, 7.0F);
        EXPECT_LT(leftmost, -40.0F);
        EXPECT_GT(rightmost, 40.0F);
    }
}

}  // namespace
}  // namespace aquarama
