// SPDX-License-Identifier: Apache-2.0
// Courtship goes through its stages and ends; who does not meet the criteria is never courted.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kFish = 6;

WorldSpecies inTheMood(WorldSpecies species, double libido) {
    species.start = config::Start{.centre = {0, -5.5F, -5}, .radiusMetres = 1.5, .libido = libido};
    return species;
}

bool isFemale(const World& world, std::uint32_t fish) {
    return (world.minds()[fish].likes & fish::kIsFemale) != 0;
}

std::uint32_t females(const World& world) {
    std::uint32_t count = 0;
    for (std::uint32_t fish = 0; fish < kFish; ++fish)
        count += static_cast<std::uint32_t>(isFemale(world, fish));
    return count;
}

TEST(Mate, WillingPairsSpawnWithinAMinute) {
    int chances = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        World world(openWater(seed, {inTheMood(pacifists(kFish), 0.6)}));
        if (females(world) == 0 || females(world) == kFish) continue;
        ++chances;
        for (int i = 0; i < 60 * 60 && world.counts().spawnings == 0; ++i) world.advance();
        EXPECT_GT(world.counts().spawnings, 0U) << "seed " << seed;
    }
    EXPECT_GE(chances, 8);
}

TEST(Mate, ThePairGoesThroughAllStagesInOrderAndBothAreSpentTogether) {
    World world(openWater(1, {inTheMood(pacifists(kFish), 0.6)}));
    std::array<std::uint8_t, kFish> reached{};
    for (int i = 0; i < 3600 && world.counts().spawnings == 0; ++i) {
        world.advance();
        for (std::uint32_t fish = 0; fish < kFish; ++fish) {
            const fish::Mind mind = world.minds()[fish];
            if (mind.intention != fish::Intention::Mate || mind.stage < 2) continue;
            EXPECT_LE(mind.stage, reached[fish] < 2 ? 5 : reached[fish] + 1);
            reached[fish] = mind.stage;
            EXPECT_NE(isFemale(world, fish), isFemale(world, mind.target));
        }
    }
    ASSERT_EQ(world.counts().spawnings, 1U);
    int spent = 0;
    for (std::uint32_t fish = 0; fish < kFish; ++fish)
        if (world.minds()[fish].sinceSpawning == 0) {
            ++spent;
            EXPECT_EQ(reached[fish], 5);
        }
    EXPECT_EQ(spent, 2);
    for (int i = 0; i < 16; ++i) world.advance();
    for (std::uint32_t fish = 0; fish < kFish; ++fish)
        EXPECT_TRUE(world.minds()[fish].sinceSpawning > 60 ||
                    world.minds()[fish].intention != fish::Intention::Mate)
            << "it is over";
}

TEST(Mate, NobodyCourtsItsOwnSexNorWhoIsNotWillingNorAnotherSpecies) {
    for (const double share : {0.0, 1.0}) {
        WorldSpecies one = inTheMood(pacifists(kFish), 0.9);
        one.habits.shares.female = share;
        WorldSpecies other = inTheMood(pacifists(kFish), 0.9);
        other.habits.shares.female = 1 - share;
        other.name = "another";
        World world(openWater(3, {one, other}));
        for (int i = 0; i < 1800; ++i) {
            world.advance();
            for (std::uint32_t fish = 0; fish < 2 * kFish; ++fish)
                ASSERT_NE(world.minds()[fish].intention, fish::Intention::Mate);
        }
    }
    WorldSpecies unwilling = inTheMood(pacifists(kFish), 0.0);
    unwilling.habits.libidoPerSecond = 1.0e-6F;
    World world(openWater(3, {unwilling}));
    for (int i = 0; i < 1800; ++i) world.advance();
    for (std::uint32_t fish = 0; fish < kFish; ++fish)
        EXPECT_NE(world.minds()[fish].intention, fish::Intention::Mate);
}

TEST(Mate, ThoseTooDifferentInSizeNever) {
    WorldSpecies species = inTheMood(pacifists(20), 0.9);
    species.size = {
        .meanMetres = 0.24F, .deviationMetres = 0.2F, .leastMetres = 0.12F, .mostMetres = 0.36F};
    World world(openWater(2, {species}));
    int courting = 0;
    for (int i = 0; i < 1800; ++i) {
        world.advance();
        for (std::uint32_t fish = 0; fish < 20; ++fish) {
            const fish::Mind mind = world.minds()[fish];
            if (mind.intention != fish::Intention::Mate) continue;
            ++courting;
            const auto [least, most] =
                std::minmax(world.view().fish[fish].length, world.view().fish[mind.target].length);
            ASSERT_GE(least, 0.7F * most);
        }
    }
    EXPECT_GT(courting, 0);
}

TEST(Mate, WhoIsNotAnsweredGivesUp) {
    // One female and many males: most wait in vain.
    WorldSpecies species = inTheMood(pacifists(kFish), 0.9);
    species.habits.shares.female = 0.2;
    World world(openWater(1, {species}));
    ASSERT_EQ(females(world), 1U);
    std::array<int, kFish> longest{};
    std::array<int, kFish> now{};
    for (int i = 0; i < 3 * 3600; ++i) {
        world.advance();
        for (std::uint32_t fish = 0; fish < kFish; ++fish) {
            const fish::Mind mind = world.minds()[fish];
            const bool waits = mind.intention == fish::Intention::Mate && mind.stage < 2;
            now[fish] = waits ? now[fish] + 1 : 0;
            longest[fish] = std::max(longest[fish], now[fish]);
        }
    }
    for (std::uint32_t fish = 0; fish < kFish; ++fish)
        EXPECT_LT(longest[fish], 33 * 60) << "fish " << fish;
}

// A school in a day that stands still at this time of day.
WorldOptions schoolAt(double timeOfDay) {
    WorldSpecies school = scads(30);
    school.habits.libidoPerSecond = 0.004F;
    school.habits.spawnsInRush = true;
    WorldOptions options = openWater(2, {inTheMood(school, 0.5)});
    options.scene.day.startsAt = timeOfDay;
    return options;
}

TEST(Mate, ASchoolSpawnsInRushesAtSunsetAndNotByDay) {
    for (const double timeOfDay : {0.5, 0.78}) {
        World world(schoolAt(timeOfDay));
        std::array<std::uint32_t, 30> followers{};
        std::uint32_t mostFollowers = 0;
        for (int i = 0; i < 60 * 60; ++i) {
            world.advance();
            followers = {};
            for (std::uint32_t fish = 0; fish < 30; ++fish) {
                const fish::Mind mind = world.minds()[fish];
                if (mind.intention != fish::Intention::Mate) continue;
                ASSERT_TRUE(mind.stage == 0 || mind.stage >= 4) << "no loop, no circle";
                if (!isFemale(world, fish) && mind.stage >= 4)
                    mostFollowers = std::max(mostFollowers, ++followers.at(mind.target));
            }
        }
        if (timeOfDay < 0.6) {
            EXPECT_EQ(world.counts().spawnings, 0U);
            EXPECT_EQ(mostFollowers, 0U);
        } else {
            EXPECT_GE(world.counts().spawnings, 4U);
            EXPECT_GE(mostFollowers, 2U) << "several males rise with one female";
        }
    }
}

TEST(Mate, HuntersFindEachOtherFromAfarThoughTheyHunger) {
    WorldSpecies lone = pacifists(2);
    lone.habits.role = config::Role::Predator;
    lone.habits.visionBodyLengths = 3;
    lone.start =
        config::Start{.centre = {0, -5.5F, -5}, .radiusMetres = 3, .hunger = 1, .libido = 0.45};
    World world(openWater(1, {lone}));
    const auto apart = [&] {
        return place::lengthOf(world.view().position(0) - world.view().position(1));
    };
    world.advance();
    ASSERT_GT(apart(), 1.0F) << "farther than they see others";
    for (int i = 0; i < 4 * 3600 && world.counts().spawnings == 0; ++i) world.advance();
    EXPECT_GT(world.counts().spawnings, 0U);
}

}  // namespace
}  // namespace aquarama::world
