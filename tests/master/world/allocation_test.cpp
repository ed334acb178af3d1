// SPDX-License-Identifier: Apache-2.0
// A program of its own: it replaces operator new to count.
#include <gtest/gtest.h>

#include "tests/master/world/few_fish.h"
#include "tests/support/count_memory.h"

namespace aquarama::world {
namespace {

TEST(World, advancingTakesNoMemory) {
    for (const unsigned threads : {1U, 2U}) {
        World world = schoolWorld(1, 1000, threads);
        for (int i = 0; i < 3; ++i) world.advance();
        const std::size_t before = test::bytesTaken;
        for (int i = 0; i < 120; ++i) world.advance();
        EXPECT_EQ(test::bytesTaken - before, 0U) << threads << " threads";
    }
}

TEST(World, mealsCatchesAndReturnsTakeNone) {
    WorldSpecies prey = scads(60);
    prey.start = config::Start{.centre = {0, -5.5F, -5}, .radiusMetres = 1, .hunger = 0.8};
    prey.habits.fear.metres = 0.4F;  // it flees late, and some are caught
    WorldSpecies hunter = sharks(1);
    hunter.start = config::Start{.centre = {-4, -5.5F, -5}, .radiusMetres = 0.5, .hunger = 1};
    hunter.habits.hunt.restSeconds = 5;
    WorldOptions options = openWater(3, {prey, hunter});
    options.scene.plankton = 300;
    options.scene.water.halfExtent = {8, 2, 6};
    World world(options);
    for (int i = 0; i < 3; ++i) world.advance();
    const std::size_t before = test::bytesTaken;
    for (int i = 0; i < 5 * 3600 && world.counts().returns == 0; ++i) world.advance();
    EXPECT_EQ(test::bytesTaken - before, 0U);
    EXPECT_GT(world.counts().meals, 0U);
    EXPECT_GT(world.counts().returns, 0U) << "nobody was eaten";
}

}  // namespace
}  // namespace aquarama::world
