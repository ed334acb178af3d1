// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "master/behaviour/home.h"
#include "tests/master/behaviour/aquarium.h"

namespace aquarama::behaviour {
namespace {

const place::Obstacles kOpenWater{{3}, {{0, -4, -5}, {6, 3, 4}}, {}};

TEST(Wandering, everyPlaceIsInTheWaterAndAnotherFollowsIt) {
    for (std::size_t fish = 0; fish < 20; ++fish) {
        int changes = 0;
        glm::vec3 before = wanderingGoal(1, kOpenWater.water, 4, fish, {0});
        for (std::uint64_t tick = 0; tick < 60 * 60; ++tick) {
            const glm::vec3 goal = wanderingGoal(1, kOpenWater.water, 4, fish, {tick});
            const glm::vec3 from = goal - kOpenWater.water.centre;
            ASSERT_LE(std::abs(from.x), kOpenWater.water.halfExtent.x);
            ASSERT_LE(std::abs(from.y), kOpenWater.water.halfExtent.y);
            ASSERT_LE(std::abs(from.z), kOpenWater.water.halfExtent.z);
            if (goal != before) ++changes;
            before = goal;
        }
        EXPECT_EQ(changes, 4) << "in a minute, one each quarter";
    }
}

// Two fish that head along +x, side by side; what the first wants.
glm::vec3 courseBeside(float rightMetres) {
    Aquarium water;
    water.speciesParameters[0].habits.role = config::Role::Pacifist;
    water.addFish({}, 0, 0.3F);
    water.addFish({0, 0, rightMetres}, 0, 0.3F);
    return water.think()[0].direction;
}

TEST(Wandering, aFishGivesWayToOneBesideIt) {
    EXPECT_LT(courseBeside(0.1F).z, courseBeside(1.0F).z - 0.05F)
        << "to the left of one on the right";
    EXPECT_GT(courseBeside(-0.1F).z, courseBeside(-1.0F).z + 0.05F);
}

}  // namespace
}  // namespace aquarama::behaviour
