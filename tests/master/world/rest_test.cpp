// SPDX-License-Identifier: Apache-2.0
// A fish that retires and rises: four blue tangs through a dusk, a night and a dawn.
#include <gtest/gtest.h>

#include "common/place/day.h"
#include "common/place/place.h"
#include "master/world/world.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {
namespace {

using place::DayPhase;

constexpr std::uint32_t kTangs = 4;
constexpr double kDaySeconds = 300;

// On the default reef, in sight of branching corals or without any.
WorldOptions tangsAtDusk(bool withCorals) {
    WorldOptions options;
    options.scene.gathering = config::Gathering::None;
    options.scene.day = {.lengthSeconds = kDaySeconds, .startsAt = 0.8, .night = 0.5};
    options.scene.plankton = 200;
    options.scene.water.halfExtent.y = 2.5F;
    options.scene.eye = {0, -6, 6};
    if (withCorals)
        options.scene.sites = {{.kind = config::SiteKind::Branching, .xz = {}, .number = 6}};
    options.cast = {capturedSpecies(test::castMember("blue_tang"), kTangs)};
    return options;
}

void advanceTo(World& world, DayPhase phase, double share) {
    const double time = place::timeIn(phase, share);
    const auto isThere = [&] {
        const double now = world.surroundings().timeOfDay;
        return now >= time && now < time + 0.01;
    };
    while (!isThere()) world.advance();
}

std::uint32_t resting(const World& world) {
    std::uint32_t count = 0;
    for (std::uint32_t fish = 0; fish < kTangs; ++fish)
        count += fish::aimOf(world.minds()[fish]).intention == fish::Intention::Rest ? 1 : 0;
    return count;
}

TEST(Rest, fishRetireToACoralAtDuskAndRiseAtDawn) {
    World world(tangsAtDusk(true));
    advanceTo(world, DayPhase::Dusk, 0.1);
    EXPECT_EQ(resting(world), 0U) << "too early";
    advanceTo(world, DayPhase::Night, 0.6);
    ASSERT_EQ(resting(world), kTangs);
    const std::uint64_t meals = world.counts().meals;
    for (std::uint32_t fish = 0; fish < kTangs; ++fish) {
        const std::uint32_t site = world.minds()[fish].target;
        ASSERT_LT(site, world.surroundings().sites.size());
        EXPECT_EQ(world.surroundings().sites[site].kind, config::SiteKind::Branching);
        const glm::vec3 from = world.view().position(fish) - world.surroundings().sites[site].place;
        EXPECT_LT(place::lengthOf(from), 0.6F) << fish;
        EXPECT_LT(world.view().fish[fish].speed, 0.15F) << fish;
    }
    advanceTo(world, DayPhase::FirstLight, 0.5);
    EXPECT_EQ(world.counts().meals, meals) << "who rests does not eat";
    EXPECT_EQ(resting(world), kTangs);
    advanceTo(world, DayPhase::Morning, 0.1);
    EXPECT_EQ(resting(world), 0U);
}

TEST(Rest, withoutACoralTheyStandSlowlyAtHome) {
    World world(tangsAtDusk(false));
    advanceTo(world, DayPhase::Night, 0.6);
    ASSERT_EQ(resting(world), kTangs);
    float speed = 0;
    for (std::uint32_t fish = 0; fish < kTangs; ++fish) {
        EXPECT_EQ(world.minds()[fish].target, fish::kNobody);
        speed += world.view().fish[fish].speed / kTangs;
    }
    EXPECT_LT(speed, 0.15F);
}

}  // namespace
}  // namespace aquarama::world
