// SPDX-License-Identifier: Apache-2.0
// A predator catches sometimes and not always; who is eaten is away for a while.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kScads = 60;
constexpr std::uint32_t kShark = kScads;

WorldOptions seaOfTheHunt(std::uint32_t seed) {
    WorldSpecies prey = scads(kScads);
    prey.start = config::Start{.centre = {0, -5.5F, -5}, .radiusMetres = 1};
    WorldSpecies hunter = sharks(1);
    hunter.start = config::Start{.centre = {-4, -5.5F, -5}, .radiusMetres = 0.5, .hunger = 1};
    WorldOptions options = openWater(seed, {prey, hunter});
    options.scene.water.halfExtent = {8, 2, 6};
    return options;
}

bool isHunting(const World& world) {
    return fish::aimOf(world.minds()[kShark]).intention == fish::Intention::Eat;
}

TEST(Hunt, SometimesCatchesAndNotAlways) {
    int chases = 0;
    std::uint64_t catches = 0;
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        World world(seaOfTheHunt(seed));
        bool hunted = false;
        for (int i = 0; i < 5 * 3600; ++i) {
            world.advance();
            const bool hunts = isHunting(world);
            if (hunts && !hunted) ++chases;
            hunted = hunts;
        }
        catches += world.counts().catches;
    }
    const double share = static_cast<double>(catches) / chases;
    RecordProperty("chases", chases);
    RecordProperty("catches", static_cast<int>(catches));
    std::cout << catches << " of " << chases << " chases ended with a catch\n";
    EXPECT_GE(chases, 20);
    EXPECT_GE(share, 0.05);
    EXPECT_LE(share, 0.4);
}

// Of seed 3: in the six minutes of seed 1 nobody is eaten.
TEST(Hunt, WhoIsEatenIsAwayAndAnotherComesFromAfar) {
    World world(seaOfTheHunt(3));
    int catches = 0;
    std::vector<std::uint64_t> awaySince(kScads + 1, 0);
    for (int i = 0; i < 6 * 3600; ++i) {
        world.advance();
        for (std::uint32_t fish = 0; fish <= kShark; ++fish) {
            const bool away = motion::isAway(world.states(), fish);
            const bool was = awaySince[fish] != 0;
            if (away && !was) {
                awaySince[fish] = world.tick().value;
                ++catches;
            }
            if (was && !away) {
                const std::uint64_t ticks = world.tick().value - awaySince[fish];
                EXPECT_GE(ticks, 20U * 60);
                EXPECT_LE(ticks, 60U * 60 + 1);
                awaySince[fish] = 0;
                const glm::vec3 eye = world.surroundings().submarine.position;
                EXPECT_GT(place::lengthOf(motion::bodyFrameOf(world.states(), fish).position - eye),
                          12);
            }
            if (away && world.tick().value > awaySince[fish] + fish::kTicksBetweenThoughts) {
                EXPECT_FALSE(isHunting(world) && world.minds()[kShark].target == fish);
            }
        }
        std::uint64_t away = 0;
        for (std::uint32_t fish = 0; fish <= kShark; ++fish)
            away += static_cast<std::uint64_t>(motion::isAway(world.states(), fish));
        ASSERT_EQ(away, world.counts().catches - world.counts().returns);
    }
    EXPECT_GT(catches, 0);
    EXPECT_GT(world.counts().returns, 0U);
}

TEST(Hunt, TheSchoolFormsAgainAfterAChase) {
    World world(seaOfTheHunt(3));
    int i = 0;
    const auto nearestMate = [&] {  // the median distance to the nearest other, body lengths
        std::vector<float> nearest;
        for (std::uint32_t fish = 0; fish < kScads; ++fish) {
            float least = 1.0e9F;
            for (std::uint32_t other = 0; other < kScads; ++other)
                if (other != fish)
                    least = std::min(least,
                                     place::lengthOf(world.view().position(other) -
                                                     world.view().position(fish)));
            nearest.push_back(least / world.view().fish[fish].length);
        }
        std::ranges::sort(nearest);
        return nearest[nearest.size() / 2];
    };
    for (; i < 3600 && !isHunting(world); ++i) world.advance();
    for (; i < 7200 && isHunting(world); ++i) world.advance();
    ASSERT_LT(i, 7200);
    float least = 100;
    for (int tick = 0; tick < 30 * 60; ++tick) {
        world.advance();
        if (tick % 60 == 0) least = std::min(least, nearestMate());
    }
    EXPECT_LT(least, 1.5F) << "body lengths to the nearest schoolmate within half a minute";
}

// Of seed 3: in the minute of seed 1 nobody is eaten.
TEST(Hunt, IsOneWorldOnAnyNumberOfThreads) {
    World one(seaOfTheHunt(3));
    WorldOptions options = seaOfTheHunt(3);
    options.threads = 2;
    World two(options);
    options.threads = 4;
    World four(options);
    for (int i = 0; i < 3600; ++i) {
        if (i == 600) {
            for (World* world : {&one, &two, &four}) world->apply(DropFood{{0, -5, -5}, 60});
        }
        one.advance();
        two.advance();
        four.advance();
        if (i % 600 == 0) {
            ASSERT_EQ(one.hash(), two.hash()) << i;
            ASSERT_EQ(one.hash(), four.hash()) << i;
        }
    }
    EXPECT_GT(one.counts().catches + one.counts().meals, 0U) << "nothing happened";
    EXPECT_EQ(one.counts(), two.counts());
    EXPECT_EQ(one.counts(), four.counts());
}

}  // namespace
}  // namespace aquarama::world
