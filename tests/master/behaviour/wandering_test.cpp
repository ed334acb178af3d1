// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/wandering.h"

#include <gtest/gtest.h>

#include "master/behaviour/angle.h"
#include "master/behaviour/perception.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama {
namespace {

const Surroundings kOpenWater{3, {{0, -4, -5}, {6, 3, 4}}, {}};

TEST(Wandering, everyPlaceIsInTheWaterAndAnotherFollowsIt) {
    for (std::size_t fish = 0; fish < 20; ++fish) {
        int changes = 0;
        glm::vec3 before = wanderingGoal(1, kOpenWater.water, fish, {0});
        for (std::uint64_t tick = 0; tick < 60 * 60; ++tick) {
            const glm::vec3 goal = wanderingGoal(1, kOpenWater.water, fish, {tick});
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

// Two fish that head along +x, a length apart; what the first wants.
glm::vec3 wishBeside(float rightMetres) {
    SchoolView view = scatteredSchool(1, 2, kOpenWater.water);
    for (std::size_t fish = 0; fish < 2; ++fish) {
        view.x[fish] = 0;
        view.y[fish] = -4;
        view.z[fish] = -5 + (fish == 1 ? rightMetres : 0.0F);
        view.headingX[fish] = 1;
        view.headingY[fish] = view.headingZ[fish] = 0;
        view.length[fish] = 0.3F;
    }
    NeighbourGrid grid(kOpenWater.water, kCellMetres, view.size());
    grid.rebuild(view);
    Intentions intentions;
    intentions.resize(2);
    Wandering{&view, &grid, &kOpenWater, 1, 1, {0}, &intentions}.run(0, 1);
    return intentions.direction(0);
}

TEST(Wandering, aFishGivesWayToOneBesideIt) {
    EXPECT_LT(wishBeside(0.1F).z, wishBeside(1.0F).z - 0.05F) << "to the left of one on the right";
    EXPECT_GT(wishBeside(-0.1F).z, wishBeside(-1.0F).z + 0.05F);
}

}  // namespace
}  // namespace aquarama
