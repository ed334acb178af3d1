// SPDX-License-Identifier: Apache-2.0
// An intruder is charged and leaves; an owner rests from a charge and bears a large shoal.
#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/think.h"
#include "master/simulation/insight.h"
#include "tests/master/world/grazing_world.h"

namespace aquarama::world {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

bool charges(const World& world, std::uint32_t fish) {
    return world.minds()[fish].intention == fish::Intention::Charge;
}

// Three clownfish at anemones half a metre from each other, for five minutes.
TEST(Charge, AnIntruderLeavesAndTheOwnerRests) {
    World world(optionsOfRoutine("charge", 1));
    const fish::SpeciesParameters& parameters = world.speciesParameters()[0];
    constexpr int kRest = 6 * 60;
    std::array<int, 3> endedAt{-kRest, -kRest, -kRest};
    std::array<bool, 3> charging{};
    int begun = 0;
    int fled = 0;
    for (int tick = 0; tick < 5 * 3600; ++tick) {
        world.advance();
        for (std::uint32_t fish = 0; fish < 3; ++fish) {
            const fish::Aim aim = fish::aimOf(world.minds()[fish]);
            const bool now = aim.intention == fish::Intention::Charge;
            if (now && !charging[fish]) {
                ++begun;
                EXPECT_GE(tick - endedAt[fish], kRest) << "fish " << fish;
                const glm::vec3 from =
                    world.view().position(aim.target) - behaviour::homeOf(parameters, fish);
                EXPECT_LT(place::lengthOf(from), 0.8F + 0.05F);
            }
            if (now) {
                const fish::Mind& other = world.minds()[aim.target];
                fled += other.intention == fish::Intention::Escape && other.target == fish ? 1 : 0;
            }
            if (!now && charging[fish]) endedAt[fish] = tick;
            charging[fish] = now;
        }
    }
    EXPECT_GE(begun, 5);
    EXPECT_EQ(world.counts().charges, static_cast<std::uint64_t>(begun));
    EXPECT_GT(fled, 30 * begun) << "who is charged flees for half a second, in the mean";
}

// An owner and so many tangs of its size in its territory.
WorldOptions ownerAmong(std::uint32_t tangs) {
    WorldOptions options = optionsOfRoutine("graze", 1);
    options.cast[0].size = {.meanMetres = 0.2F, .leastMetres = 0.2F, .mostMetres = 0.2F};
    WorldSpecies owner = options.cast[0];
    owner.name = "owner";
    owner.fish = 1;
    owner.habits.graze.reset();
    owner.habits.territory = config::Territory{.radiusMetres = 3};
    WorldSpecies shoal = options.cast[0];
    shoal.fish = tangs;
    options.cast = {owner, shoal};
    return options;
}

behaviour::Senses sensesOfOwner(std::uint32_t tangs) {
    World world(ownerAmong(tangs));
    world.advance();
    return behaviour::perceive(
        world.environment(), world.speciesParameters()[0], 0, world.minds()[0]);
}

TEST(Charge, AShoalOfMoreThanEightIsBorne) {
    EXPECT_TRUE(sensesOfOwner(8).territory.holds);
    EXPECT_TRUE(sensesOfOwner(8).territory.intruder.seen());
    EXPECT_FALSE(sensesOfOwner(9).territory.intruder.seen());
    EXPECT_FALSE(sensesOfOwner(0).territory.intruder.seen());
}

TEST(Charge, WhoLeadsAShoalRemembersItAndGoesOnAfterTheSecond) {
    World world(ownerAmong(4));
    constexpr std::uint32_t kLeader = 1;
    while (world.counts().charges == 0 && world.tick().value < 3600) world.advance();
    ASSERT_EQ(world.counts().charges, 1U);
    EXPECT_EQ(world.minds()[kLeader].charged, fish::kChargedOnce);
    while (world.minds()[kLeader].intention != fish::Intention::Graze) world.advance();
    fish::Minds minds = world.minds();
    fish::Courses courses = world.courses();
    behaviour::DeferredEvents events;
    const std::uint32_t patch = minds[kLeader].target;
    minds[kLeader].charged = fish::kChargedTwice;
    for (int thought = 0; thought < 2; ++thought)
        behaviour::think(world.environment(), kLeader, minds, courses, events);
    EXPECT_EQ(minds[kLeader].intention, fish::Intention::Graze);
    EXPECT_NE(minds[kLeader].target, patch);
    EXPECT_EQ(minds[kLeader].charged, 0);
}

TEST(Charge, ItIsExplained) {
    World world(optionsOfRoutine("charge", 1));
    for (int tick = 0; tick < 5 * 3600; ++tick) {
        world.advance();
        for (std::uint32_t fish = 0; fish < 3; ++fish) {
            if (!charges(world, fish)) continue;
            const std::vector<std::string> names{"clownfish"};
            const auto insight = simulation::insightInto(world, fish);
            ASSERT_TRUE(insight);
            const std::vector<std::string> lines =
                simulation::explanationOf(*insight, {world.view(), names}).lines;
            EXPECT_THAT(lines, Contains(AllOf(HasSubstr("INTENDS"), HasSubstr("charge #"))));
            EXPECT_THAT(lines, Contains(HasSubstr("territory")));
            return;
        }
    }
    FAIL() << "nobody was charged";
}

TEST(Graze, ItIsExplained) {
    World world(optionsOfRoutine("graze", 1));
    for (int tick = 0; tick < 120; ++tick) world.advance();
    const std::vector<std::string> names{"blue_tang"};
    int told = 0;
    for (std::uint32_t fish = 0; fish < 8; ++fish) {
        if (world.minds()[fish].intention != fish::Intention::Graze) continue;
        const auto insight = simulation::insightInto(world, fish);
        ASSERT_TRUE(insight);
        EXPECT_THAT(simulation::explanationOf(*insight, {world.view(), names}).lines,
                    Contains(AllOf(HasSubstr("INTENDS"), HasSubstr("graze patch "))));
        ++told;
    }
    EXPECT_GT(told, 0);
}

}  // namespace
}  // namespace aquarama::world
