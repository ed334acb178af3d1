// SPDX-License-Identifier: Apache-2.0
// A cue for the time of day: the light glides to it without a jump, fish live by it, and the clock
// goes on behind it.
#include <algorithm>
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "common/place/day.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {
namespace {

using place::DayPhase;

constexpr double kGlideSeconds = 40;
constexpr std::uint32_t kTangs = 4;

double timeIn(DayPhase phase) {
    return place::timeIn(phase, 0.5);
}

// Four blue tangs that sleep in corals, on a day of 1200 s that begins at noon.
WorldOptions tangsAtNoon() {
    WorldOptions options;
    options.scene.gathering = config::Gathering::None;
    options.scene.day = {.lengthSeconds = 1200, .startsAt = 0.5, .night = 0.5};
    options.scene.plankton = 200;
    options.scene.water.halfExtent.y = 2.5F;
    options.scene.eye = {0, -6, 6};
    options.scene.sites = {{.kind = config::SiteKind::Branching, .xz = {}, .number = 6}};
    options.cast = {capturedSpecies(test::castMember("blue_tang"), kTangs)};
    return options;
}

double timeOf(const World& world) {
    return world.surroundings().timeOfDay;
}

// The shortest way on the circle of the day.
double apart(double one, double other) {
    const double way = std::abs(one - other);
    return std::min(way, 1 - way);
}

// The greatest change of time and of light in a tick of so many seconds.
struct Steps {
    double time = 0, light = 0;
};
Steps stepsIn(World& world, double seconds) {
    Steps most;
    for (int tick = 0; tick < static_cast<int>(60 * seconds); ++tick) {
        const double time = timeOf(world);
        const double light = double{world.surroundings().daylight};
        world.advance();
        most.time = std::max(most.time, apart(time, timeOf(world)));
        most.light = std::max(most.light, std::abs(light - double{world.surroundings().daylight}));
    }
    return most;
}

class DayCue : public ::testing::Test {
  protected:
    World world{tangsAtNoon()};
    World clock{tangsAtNoon()};  // without a cue

    void cue(DayPhase phase) { world.apply(SetDay{timeIn(phase), kGlideSeconds}); }
    void cueClock() { world.apply(SetDay{std::nullopt, kGlideSeconds}); }
    void pass(int seconds) {
        for (int tick = 0; tick < 60 * seconds; ++tick) world.advance();
    }
};

TEST_F(DayCue, theLightGlidesToDuskAndStays) {
    pass(5);
    cue(DayPhase::Dusk);
    const Steps most = stepsIn(world, kGlideSeconds);
    std::cout << "noon to dusk: most " << most.time << " of the day and " << most.light
              << " of the light in a tick\n";
    EXPECT_LT(most.light, 1.0 / 256) << "no step that a picture shows";
    pass(120);
    EXPECT_EQ(timeOf(world), timeIn(DayPhase::Dusk));
    cue(DayPhase::Dusk);
    world.advance();
    EXPECT_EQ(timeOf(world), timeIn(DayPhase::Dusk)) << "the same cue again changes nothing";
}

TEST_F(DayCue, theClockGoesOnBehindItAndTakesOverAgain) {
    cue(DayPhase::Night);
    pass(100);
    cueClock();
    const Steps most = stepsIn(world, kGlideSeconds);
    EXPECT_LT(most.light, 1.0 / 256);
    world.advance();
    for (int tick = 0; tick < 60 * 140 + 1; ++tick) clock.advance();
    EXPECT_EQ(timeOf(world), timeOf(clock));
    EXPECT_FALSE(world.surroundings().dayCue);
}

// A cue of a phase that has just passed goes back a little; all others go on as the sun does.
TEST(DayCues, goForwardButForLessThanAQuarterOfADay) {
    for (int from = 0; from < int{place::kDayPhases}; ++from)
        for (int to = 0; to < int{place::kDayPhases}; ++to) {
            const double one = timeIn(static_cast<DayPhase>(from));
            const double other = timeIn(static_cast<DayPhase>(to));
            const double way = surroundings::wayBetween(one, other);
            EXPECT_GT(way, -0.25);
            EXPECT_LE(way, 0.75);
            EXPECT_NEAR(std::remainder(one + way - other, 1), 0, 1e-12);
        }
    EXPECT_GT(surroundings::wayBetween(timeIn(DayPhase::Noon), timeIn(DayPhase::Dusk)), 0);
    EXPECT_GT(surroundings::wayBetween(timeIn(DayPhase::Dusk), timeIn(DayPhase::Noon)), 0)
        << "through the night to the next noon";
    EXPECT_LT(surroundings::wayBetween(timeIn(DayPhase::Night), timeIn(DayPhase::Dusk)), 0)
        << "no whole day in between";
}

// Another cue on the way begins where the light is.
TEST_F(DayCue, anotherOnTheWayMakesNoJump) {
    for (const DayPhase phase : {DayPhase::Dusk, DayPhase::Dawn, DayPhase::Noon}) {
        cue(phase);
        EXPECT_LT(stepsIn(world, kGlideSeconds / 2).time, 0.001);
    }
}

TEST_F(DayCue, fishRetireByIt) {
    const auto resting = [this] {
        std::uint32_t count = 0;
        for (std::uint32_t fish = 0; fish < kTangs; ++fish)
            count += fish::aimOf(world.minds()[fish]).intention == fish::Intention::Rest ? 1 : 0;
        return count;
    };
    pass(20);
    EXPECT_EQ(resting(), 0U);
    cue(DayPhase::Night);
    pass(80);
    EXPECT_EQ(resting(), kTangs);
    cue(DayPhase::Noon);
    pass(60);
    EXPECT_EQ(resting(), 0U);
}

TEST_F(DayCue, isPartOfTheHashWhileItHolds) {
    for (World* one : {&world, &clock}) one->advance();
    ASSERT_EQ(world.hash(), clock.hash());
    cueClock();
    EXPECT_EQ(world.hash(), clock.hash()) << "nothing to go back from";
    cue(DayPhase::Noon);
    EXPECT_NE(world.hash(), clock.hash());
}

}  // namespace
}  // namespace aquarama::world
