// SPDX-License-Identifier: Apache-2.0
// Predators of a reef: one that hangs, one that lies at a ledge, and the shark on patrol.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/patrol.h"
#include "master/behaviour/routines.h"
#include "tests/master/behaviour/fish_in_mind.h"
#include "tests/master/world/reef_water.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kCloud = 60;

// A hunter of the cloud that is hungry again soon, so that a test sees it strike.
WorldSpecies hungry(WorldSpecies hunter) {
    hunter.habits.hunts = {"prey"};
    hunter.habits.hunger.digestionPerSecond = 0.02F;
    hunter.habits.hunt.restSeconds = hunter.habits.hunt.restByDaySeconds = 20;
    return hunter;
}

// A parrotfish that lies in wait at ledges.
WorldSpecies ledgeHunter() {
    WorldSpecies hunter = capturedSpecies(test::castMember("parrotfish"), 1);
    hunter.name = "ledge_hunter";
    hunter.habits.role = config::Role::Predator;
    hunter.habits.libidoPerSecond = 0;
    hunter.habits.hunger.eatsPlankton = false;
    hunter.habits.hunger.appetiteParticles = 1;
    hunter.habits.shares = {};
    hunter.habits.home = {.kind = config::HomeKind::Place,
                          .radiusMetres = 0.6,
                          .leashMetres = 3,
                          .onTheReef = true,
                          .site = config::SiteKind::Ledge,
                          .group = 1};
    hunter.habits.hunt = {
        .chaseSeconds = 1.5, .giveUpMetres = 2.5, .ambush = config::Ambush{1.5, 1, 0, 3}};
    return hunter;
}

std::vector<config::SiteGroup> ledges() {
    return {{.kind = config::SiteKind::Branching, .xz = kRightHead},
            {.kind = config::SiteKind::Ledge, .xz = glm::vec2{3.3F, -2.6F}},
            {.kind = config::SiteKind::Ledge, .number = 5}};
}

struct Strikes {
    int rushes = 0;
    std::uint64_t catches = 0;
};

// The strikes of the second species, one fish, in so many minutes.
Strikes strikesIn(const WorldOptions& options, int minutes) {
    World world(options);
    const std::uint32_t hunter = options.cast.front().fish;
    Strikes strikes;
    bool rushed = false;
    for (int tick = 0; tick < minutes * 3600; ++tick) {
        world.advance();
        const bool rushes = behaviour::isRushing(world.minds()[hunter]);
        if (rushes && !rushed) ++strikes.rushes;
        rushed = rushes;
    }
    strikes.catches = world.counts().catches;
    return strikes;
}

void expectsSomeCatches(const Strikes& strikes, int leastRushes) {
    const double share = static_cast<double>(strikes.catches) / strikes.rushes;
    std::cout << strikes.catches << " of " << strikes.rushes << " strikes caught\n";
    EXPECT_GE(strikes.rushes, leastRushes);
    EXPECT_GE(strikes.catches, 1U);
    EXPECT_LE(share, 0.25);
}

TEST(Hunters, aTrumpetfishHangsHeadDownAtTheEdgeOfACloud) {
    World world(reefWater(1,
                          ledges(),
                          {cloudOver(kRightHead, "green_chromis", kCloud),
                           capturedSpecies(test::castMember("trumpetfish"), 2)}));
    int steep = 0;
    int ticks = 0;
    for (int tick = 0; tick < 10 * 3600; ++tick) {
        world.advance();
        if (tick < 3600) continue;
        for (std::uint32_t fish = kCloud; fish < kCloud + 2; ++fish, ++ticks)
            steep += world.view().heading(fish).y < -0.7F ? 1 : 0;
    }
    const double share = static_cast<double>(steep) / ticks;
    std::cout << "head down by more than 45 degrees: " << 100 * share << " % of the time\n";
    EXPECT_GT(share, 0.3);
}

TEST(Hunters, aTrumpetfishCatchesNowAndThen) {
    Strikes all;
    for (std::uint32_t seed = 1; seed <= 7; ++seed) {
        const Strikes strikes =
            strikesIn(reefWater(seed,
                                ledges(),
                                {cloudOver(kRightHead, "prey", kCloud),
                                 hungry(capturedSpecies(test::castMember("trumpetfish"), 1))}),
                      10);
        all.rushes += strikes.rushes;
        all.catches += strikes.catches;
    }
    expectsSomeCatches(all, 10);
}

TEST(Hunters, oneAtALedgeCatchesNowAndThen) {
    Strikes all;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const Strikes strikes = strikesIn(
            reefWater(
                seed, ledges(), {cloudOver(kRightHead, "prey", kCloud), hungry(ledgeHunter())}),
            10);
        all.rushes += strikes.rushes;
        all.catches += strikes.catches;
    }
    expectsSomeCatches(all, 10);
}

TEST(Hunters, oneAtALedgeStaysAtLedgesAndMovesBetweenThem) {
    World world(reefWater(5, ledges(), {ledgeHunter()}));
    std::set<std::size_t> visited;
    int near = 0;
    int ticks = 0;
    for (int tick = 0; tick < 20 * 3600; ++tick) {
        world.advance();
        if (tick < 3600) continue;
        ++ticks;
        const std::vector<place::Site>& sites = world.surroundings().sites;
        for (std::size_t i = 0; i < sites.size(); ++i) {
            if (sites[i].kind != config::SiteKind::Ledge ||
                place::lengthOf(sites[i].place - world.view().position(0)) > 0.8F)
                continue;
            visited.insert(i);
            ++near;
            break;
        }
    }
    std::cout << visited.size() << " ledges, " << 100 * near / ticks << " % of the time there\n";
    EXPECT_GE(visited.size(), 2U);
    EXPECT_GE(near, ticks / 2);
}

// Fish hide side by side: each has another in its box.
TEST(Hunters, whoHidesComesOutThoughOthersAreInItsWay) {
    behaviour::FishInMind prey;
    prey.parameters.habits.hidesIn = {config::SiteKind::Branching};
    prey.senses.shelter.site = {.object = 2, .offset = {0.1F, 0, 0}, .distance = 0.1F};
    prey.feelings.threat = 1;
    prey.threaten(9);
    EXPECT_EQ(prey.think(), fish::Intention::Hide);
    prey.feelings.threat = 0;
    EXPECT_EQ(prey.think(), fish::Intention::Hide) << "it does not venture out yet";
    prey.senses.shelter.venturesOut = true;
    EXPECT_EQ(prey.think(), fish::Intention::AvoidFish);
    EXPECT_NE(fish::aimOf(prey.mind).intention, fish::Intention::Hide);
    prey.senses.shelter.venturesOut = false;
    prey.clearTheWay();
    EXPECT_NE(prey.think(), fish::Intention::Hide);
}

TEST(Hunters, aSharkRestsLongerByDayThanAtDusk) {
    behaviour::FishInMind shark(config::Role::Predator);
    shark.parameters.habits.hunt = {.restSeconds = 300, .restByDaySeconds = 900};
    shark.feelings.hunger = 1;
    shark.showPrey(3);
    shark.mind.sinceChase = 400 * 60;
    EXPECT_EQ(shark.rule(behaviour::PriorityRule::Hunger).verdict, behaviour::Verdict::Resting);
    shark.senses.huntersActive = 1;
    EXPECT_EQ(shark.rule(behaviour::PriorityRule::Hunger).verdict, behaviour::Verdict::Wins);
}

TEST(Hunters, areActiveFromDuskOnAndNotByDay) {
    surroundings::Surroundings around;
    EXPECT_FLOAT_EQ(surroundings::huntersActive(around), 0.0F);
    around.timeOfDay = 0.7;
    EXPECT_FLOAT_EQ(surroundings::huntersActive(around), 0.0F) << "in the afternoon";
    around.timeOfDay = 0.87;
    EXPECT_FLOAT_EQ(surroundings::huntersActive(around), 1.0F) << "at dusk";
    around.timeOfDay = 0;
    EXPECT_FLOAT_EQ(surroundings::huntersActive(around), 1.0F) << "by night";
}

// Means over a world with one shark.
struct Patrol {
    double height = 0;       // as a share of the half height of the water
    double outwards = 0;     // as a share of the half extent in plan
    double inTheMiddle = 0;  // share of the time
    std::size_t stretches = 0;
    float metresOutside = 0;
};

Patrol patrolOf(double timeOfDay) {
    WorldOptions options =
        reefWater(1, {}, {capturedSpecies(test::castMember("blacktip_reef_shark"), 1)});
    options.scene.day.startsAt = timeOfDay;
    options.scene.day.night = 0.3;
    World world(options);
    const place::Region& water = world.surroundings().obstacles.water;
    Patrol patrol;
    std::set<int> stretches;
    int ticks = 0;
    for (int tick = 0; tick < 20 * 3600; ++tick) {
        world.advance();
        const glm::vec3 from = (world.view().position(0) - water.centre) / water.halfExtent;
        const glm::vec3 beyond =
            glm::abs(world.view().position(0) - water.centre) - water.halfExtent;
        patrol.metresOutside = std::max({patrol.metresOutside, beyond.x, beyond.y, beyond.z});
        if (tick < 3600) continue;
        const float out = std::sqrt(from.x * from.x + from.z * from.z);
        patrol.height += static_cast<double>(from.y);
        patrol.outwards += static_cast<double>(out);
        patrol.inTheMiddle += out < 0.2F ? 1 : 0;
        stretches.insert(static_cast<int>(std::atan2(from.z, from.x) * 6 / place::kPi + 6.5F));
        ++ticks;
    }
    patrol.height /= ticks;
    patrol.outwards /= ticks;
    patrol.inTheMiddle /= ticks;
    patrol.stretches = stretches.size();
    return patrol;
}

TEST(Hunters, aSharkPatrolsHighAtTheBorderByDayAndLowerAndNearerByNight) {
    const Patrol day = patrolOf(0.5);
    const Patrol night = patrolOf(0);
    std::cout << "by day " << day.outwards << " out, " << day.height << " high, by night "
              << night.outwards << " out, " << night.height << " high\n";
    EXPECT_GT(day.outwards, 0.6);
    EXPECT_LT(day.inTheMiddle, 0.05);
    EXPECT_LT(std::max(day.metresOutside, night.metresOutside), 0.6F) << "half a turn";
    EXPECT_GT(day.height, 0.3);
    EXPECT_GE(day.stretches, 5U) << "it does not stay at one place";
    EXPECT_LT(night.outwards, day.outwards - 0.05);
    EXPECT_LT(night.height, day.height - 0.3);
}

}  // namespace
}  // namespace aquarama::world
