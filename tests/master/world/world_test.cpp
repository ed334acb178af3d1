// SPDX-License-Identifier: Apache-2.0
#include "master/world/world.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/master/world/captured_fish.h"
#include "tests/support/instruction_sets.h"

namespace aquarama::world {
namespace {

std::uint64_t hashAfter(World world, int ticks) {
    for (int i = 0; i < ticks; ++i) world.advance();
    return world.hash();
}

TEST(World, oneSeedIsOneWorldOnAnyNumberOfThreads) {
    for (const std::uint32_t fish : {51U, 1500U}) {
        const std::uint64_t alone = hashAfter(schoolWorld(1, fish, 1), 600);
        std::printf("hash of %u fish after 600 ticks: %016llx\n",
                    fish,
                    static_cast<unsigned long long>(alone));
        EXPECT_EQ(alone, hashAfter(schoolWorld(1, fish, 2), 600));
        EXPECT_EQ(alone, hashAfter(schoolWorld(1, fish, 4), 600));
    }
}

TEST(World, oneSeedIsOneWorldOnEveryInstructionSet) {
    std::set<std::uint64_t> hashes;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        test::useOnly(target);
        hashes.insert(hashAfter(schoolWorld(1, 51), 600));
        EXPECT_EQ(hashes.size(), 1U) << hwy::TargetName(target);
    }
    test::useOnly(0);  // all again
}

TEST(World, anotherSeedIsAnotherWorld) {
    EXPECT_NE(schoolWorld(1, 51).hash(), schoolWorld(2, 51).hash());
    EXPECT_NE(hashAfter(schoolWorld(1, 51), 60), hashAfter(schoolWorld(2, 51), 60));
}

TEST(World, theHashSeesASingleTick) {
    World world = schoolWorld(1, 51);
    const std::uint64_t before = world.hash();
    world.advance();
    EXPECT_NE(world.hash(), before);
    EXPECT_EQ(world.tick(), Tick{1});
}

// Before any fish has seen it: a replay that lacks it is told at the next checkpoint.
TEST(World, theHashSeesAtOnceWhatReachesTheWorldFromOutside) {
    World world = schoolWorld(1, 51);
    std::set<std::uint64_t> hashes{world.hash()};
    world.apply(DropFood{.position = {0, -5, -5}});
    hashes.insert(world.hash());
    world.apply(MoveSubmarine{{0, -6, -1}, {}});
    hashes.insert(world.hash());
    world.apply(MoveSubmarine{{0, -6, -1}, {0, 0, -0.1F}});
    hashes.insert(world.hash());
    EXPECT_EQ(hashes.size(), 4U);
}

TEST(World, recordsAreTheStates) {
    World world = schoolWorld(1, 51);
    world.advance();
    std::vector<motion::FishRecord> records;
    world.records(records);
    ASSERT_EQ(records.size(), 51U);
    for (std::size_t fish = 0; fish < records.size(); ++fish)
        EXPECT_EQ(records[fish], motion::recordOf(world.states(), fish));
}

TEST(World, lengthsVaryAboutTheSpeciesMeanWithinItsBounds) {
    const World world = schoolWorld(3, 2000);
    double sum = 0;
    double squares = 0;
    for (const motion::FishTraits& fish : world.traits()) {
        EXPECT_GE(fish.lengthMillimetres, 200);
        EXPECT_LE(fish.lengthMillimetres, 280);
        sum += fish.lengthMillimetres;
        squares += double{1} * fish.lengthMillimetres * fish.lengthMillimetres;
    }
    const double mean = sum / 2000;
    EXPECT_NEAR(mean, 240, 1.5);
    EXPECT_NEAR(squares / 2000 - mean * mean, 12 * 12, 20);
}

TEST(World, tailBeatsBeginAtPhasesOfAllTheCycle) {
    const World world = schoolWorld(1, 51);
    int quarters[4] = {};
    for (const std::uint16_t phase : world.states().phase) ++quarters[phase / 16384];
    for (const int fish : quarters) EXPECT_GT(fish, 5);
}

TEST(World, withoutFishItIsEmptyWater) {
    World sea = schoolWorld(1, 0);
    for (int i = 0; i < 60; ++i) sea.advance();
    std::vector<motion::FishRecord> records;
    sea.records(records);
    EXPECT_TRUE(records.empty());
}

}  // namespace
}  // namespace aquarama::world
