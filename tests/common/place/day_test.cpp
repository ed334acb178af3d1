// SPDX-License-Identifier: Apache-2.0
// The eight phases of a day, its brightness and its clock.
#include "common/place/day.h"

#include <cmath>

#include <gtest/gtest.h>

namespace aquarama::place {
namespace {

// The time of day so many seconds after the beginning of dawn, where a day has 1200.
double at(double secondsFromDawn) {
    const double time = beginOf(DayPhase::Dawn) + secondsFromDawn / 1200;
    return time >= 1 ? time - 1 : time;
}

TEST(Day, phasesLastAsLongAsTheTableSays) {
    struct Row {
        DayPhase phase;
        double from, to;
    };
    constexpr Row kTable[]{{DayPhase::Dawn, 0, 120},
                           {DayPhase::Morning, 120, 330},
                           {DayPhase::Noon, 330, 480},
                           {DayPhase::Afternoon, 480, 690},
                           {DayPhase::Sunset, 690, 780},
                           {DayPhase::Dusk, 780, 870},
                           {DayPhase::Night, 870, 1110},
                           {DayPhase::FirstLight, 1110, 1200}};
    for (const Row& row : kTable) {
        EXPECT_NEAR(beginOf(row.phase), at(row.from), 1e-9) << nameOf(row.phase);
        for (const double inside : {0.01, 0.5, 0.99}) {
            const double time = at(row.from + inside * (row.to - row.from));
            EXPECT_EQ(phaseOf(time), row.phase) << nameOf(row.phase) << ' ' << inside;
            EXPECT_NEAR(passedOf(time), inside, 1e-9) << nameOf(row.phase);
        }
    }
}

TEST(Day, halfADayIsTheMiddleOfNoonAndItsBeginningIsNight) {
    EXPECT_EQ(phaseOf(0.5), DayPhase::Noon);
    EXPECT_NEAR(passedOf(0.5), 0.5, 1e-9);
    EXPECT_EQ(phaseOf(0), DayPhase::Night);
    EXPECT_EQ(phaseOf(1), DayPhase::Night);
}

TEST(Day, aTimeInAPhaseIsWithinTheDay) {
    EXPECT_NEAR(timeIn(DayPhase::Noon, 0.5), 0.5, 1e-9);
    EXPECT_NEAR(timeIn(DayPhase::Night, 0.75), 0.0375, 1e-9);
    EXPECT_NEAR(timeIn(DayPhase::FirstLight, -1.5), 0.975, 1e-9);
}

TEST(Day, itIsDayFromTheEndOfDawnUntilSunset) {
    EXPECT_FALSE(isDaytime(at(119.9)));
    EXPECT_TRUE(isDaytime(at(120.1)));
    EXPECT_TRUE(isDaytime(at(689.9)));
    EXPECT_FALSE(isDaytime(at(690.1)));
    EXPECT_FALSE(isDaytime(0));
}

TEST(Day, isFullyBrightByDayAndDarkestAtNight) {
    const config::Day day{.lengthSeconds = 1200, .startsAt = 0.5, .night = 0.3};
    for (const double seconds : {120.1, 405.0, 689.9})
        EXPECT_EQ(daylightAt(day, at(seconds)), 1.0F);
    for (const double seconds : {870.1, 990.0, 1109.9})
        EXPECT_EQ(daylightAt(day, at(seconds)), 0.3F);
    // Halfway up and down, and a quarter: 3/4^2 - 2/4^3 = 0.15625.
    EXPECT_NEAR(daylightAt(day, at(1110 + 105)), 0.65, 1e-6);
    EXPECT_NEAR(daylightAt(day, at(690 + 90)), 0.65, 1e-6);
    EXPECT_NEAR(daylightAt(day, at(690 + 45)), 0.3 + 0.7 * (1 - 0.15625), 1e-6);
}

// Neither the light nor a value of the phases changes in a tick by more than a smoothstep over its
// shortest time can.
TEST(Day, nothingJumps) {
    const config::Day day{.lengthSeconds = 1200, .startsAt = 0.3, .night = 0};
    const ByPhase values{0, 1, 0.5F, 0.5F, -1, 2, 0, 1};
    const DayClock clock = clockOf(day);
    constexpr double kTicks = 60;
    const double mostLight = 1.5 / (180 * kTicks) + 1e-6;
    const double mostValue = 3 * 1.5 / (45 * kTicks) + 1e-6;
    float light = daylightAt(day, clock.timeOfDay);
    float value = valueAt(values, clock.timeOfDay);
    for (std::uint64_t tick = 1; tick <= 72'000; ++tick) {
        const double time = timeOfDayAt(clock, {tick});
        ASSERT_GE(time, 0);
        ASSERT_LT(time, 1);
        ASSERT_LE(std::abs(daylightAt(day, time) - light), mostLight) << tick;
        ASSERT_LE(std::abs(valueAt(values, time) - value), mostValue) << tick;
        light = daylightAt(day, time);
        value = valueAt(values, time);
    }
    EXPECT_NEAR(timeOfDayAt(clock, {72'000}), 0.3, 1e-9) << "a day later";
}

TEST(Day, aValueIsItsPhasesOwnFromTheMiddleOfThePhaseOn) {
    const ByPhase values{1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_EQ(valueAt(values, at(60.1)), 1.0F);
    EXPECT_EQ(valueAt(values, at(230)), 2.0F);
    EXPECT_NEAR(valueAt(values, at(30)), 4.5F, 1e-4F) << "half of it from the night's side";
    EXPECT_EQ(valueAt({3, 3, 3, 3, 3, 3, 3, 3}, at(10)), 3.0F);
}

TEST(Day, aDayWithoutLengthStandsStill) {
    const DayClock clock = clockOf({.lengthSeconds = 0, .startsAt = 0.25});
    EXPECT_EQ(timeOfDayAt(clock, {1'000'000}), 0.25);
    EXPECT_EQ(clockOf({.lengthSeconds = 0, .startsAt = 1}).timeOfDay, 0);
}

TEST(Day, aClockThatIsSetGoesOnFromThere) {
    const DayClock clock{.since = {600}, .timeOfDay = 0.9, .lengthSeconds = 100};
    EXPECT_DOUBLE_EQ(timeOfDayAt(clock, {600}), 0.9);
    EXPECT_NEAR(timeOfDayAt(clock, {600 + 60 * 20}), 0.1, 1e-12);
}

}  // namespace
}  // namespace aquarama::place
