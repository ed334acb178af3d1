// SPDX-License-Identifier: Apache-2.0
// The hall's clock, mapped onto the day of a scene.
#include "master/conductor/hall_clock.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/place/day.h"

namespace aquarama::conductor {
namespace {

using place::DayPhase;

constexpr double kHour = 60;

TEST(HallClock, withoutHoursItIsTheSuns) {
    const HallDay day = hallDayOf({});
    EXPECT_NEAR(timeOfDayAt(day, 6 * kHour), place::beginOf(DayPhase::Dawn), 1e-9);
    EXPECT_EQ(place::phaseOf(timeOfDayAt(day, 12 * kHour)), DayPhase::Noon);
    EXPECT_EQ(place::phaseOf(timeOfDayAt(day, 17.5 * kHour)), DayPhase::Sunset);
    EXPECT_NEAR(timeOfDayAt(day, 18 * kHour), place::beginOf(DayPhase::Dusk), 1e-9);
    EXPECT_EQ(place::phaseOf(timeOfDayAt(day, 0)), DayPhase::Night);
}

TEST(HallClock, duskComesAtClosingTime) {
    const HallDay day = hallDayOf(config::OpenTimes{10 * 60, 18 * 60});
    EXPECT_NEAR(timeOfDayAt(day, 10 * kHour), place::beginOf(DayPhase::Morning), 1e-9);
    EXPECT_EQ(place::phaseOf(timeOfDayAt(day, 14 * kHour)), DayPhase::Afternoon);
    EXPECT_EQ(place::phaseOf(timeOfDayAt(day, 17.5 * kHour)), DayPhase::Dusk);
    EXPECT_EQ(place::phaseOf(timeOfDayAt(day, 18.1 * kHour)), DayPhase::Night);
    const HallDay late = hallDayOf(config::OpenTimes{20 * 60, 26 * 60});
    EXPECT_EQ(place::phaseOf(timeOfDayAt(late, 1.75 * kHour)), DayPhase::Dusk);
}

// In a minute no clock of these makes a step of more than a hundredth of a day, and none goes back.
TEST(HallClock, goesForwardWithoutAJump) {
    for (const auto& open : {std::optional<config::OpenTimes>{},
                             std::optional{config::OpenTimes{10 * 60, 18 * 60}},
                             std::optional{config::OpenTimes{20 * 60, 26 * 60}}}) {
        const HallDay day = hallDayOf(open);
        for (int minute = 0; minute < 1440; ++minute) {
            const double step = timeOfDayAt(day, (minute + 1) % 1440) - timeOfDayAt(day, minute);
            const double forward = step < -0.5 ? step + 1 : step;
            ASSERT_GT(forward, 0) << minute;
            ASSERT_LT(forward, 0.01) << minute;
        }
    }
}

// The hall's day without hours goes at a day's own pace: noon is 0.4875, and ten minutes later
// 0.65 / 72 more.
TEST(HallClock, aCorrectionBringsTheSceneToTheHallByTheNextOne) {
    const HallClock hall{hallDayOf({}), 12 * kHour};
    const double pace = 0.65 / 72;
    EXPECT_NEAR(hall.setting().timeOfDay, 0.4875, 1e-9);
    EXPECT_NEAR(hall.setting().lengthSeconds, 600 / pace, 1e-3);
    const world::SetClock late = hall.correction(0.48);
    EXPECT_EQ(late.timeOfDay, 0.48) << "no jump";
    EXPECT_NEAR(late.timeOfDay + 600 / late.lengthSeconds, 0.4875 + pace, 1e-9);
    EXPECT_EQ(hall.correction(0.51).lengthSeconds, 0) << "it is ahead, and waits";
    EXPECT_NEAR(hall.correction(0.1).timeOfDay, 0.4875, 1e-9) << "too far off";
}

TEST(HallClock, readsTheHoursOfTheRigWhereThereAreSome) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("aquarama-hall-clock-" + std::to_string(getpid()));
    constexpr long long kThursdayFourPm = 16 * 3600;  // 1970-01-01 in UTC
    std::ofstream(file) << "zone: \"UTC\" open { days: [THURSDAY] from: \"9:00\" to: \"17:00\" }";
    EXPECT_NEAR(readHallClock(file, kThursdayFourPm).setting().timeOfDay,
                timeOfDayAt(hallDayOf(config::OpenTimes{9 * 60, 17 * 60}), 16 * kHour),
                1e-9);
    std::ofstream(file) << "zone: \"UTC\" open { days: [FRIDAY] from: \"9:00\" to: \"17:00\" }";
    const double sunny = timeOfDayAt(hallDayOf({}), 16 * kHour);
    EXPECT_NEAR(readHallClock(file, kThursdayFourPm).setting().timeOfDay, sunny, 1e-9)
        << "closed on this day";
    std::ofstream(file) << "no hours";
    EXPECT_NO_THROW(static_cast<void>(readHallClock(file, kThursdayFourPm)));
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace aquarama::conductor
