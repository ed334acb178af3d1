// SPDX-License-Identifier: Apache-2.0
#include "common/config/hours.h"

#include <array>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::config {
namespace {

constexpr long long kMinute = 60, kHour = 3600, kDay = 86400;
constexpr long long kNewYear2026 = 1767222000;  // in Berlin, 2025-12-31 23:00 UTC

Hours hoursOf(const std::string& rest) {
    return parseHours("zone: \"Europe/Berlin\"\n" + rest, "hours.txtpb");
}

const std::string kDaily =
    "open { days: [MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SATURDAY, SUNDAY] from: \"10:00\" "
    "to: \"18:00\" scene: \"reef\" quality: \"high\" }\n";

WantedHours at(const Hours& hours, long long unixSeconds) {
    return wantedAt(hours, civilTime(hours.zone, unixSeconds));
}

// How many minutes of each local day of the year it is open, by "month-day".
std::map<std::string, int> openMinutes(const Hours& hours) {
    std::map<std::string, int> open;
    for (long long t = kNewYear2026; t < kNewYear2026 + 365 * kDay; t += kMinute) {
        const CivilTime civil = civilTime(hours.zone, t);
        int& minutes = open[std::to_string(civil.month) + "-" + std::to_string(civil.day)];
        if (wantedAt(hours, civil).isOpen) ++minutes;
    }
    return open;
}

TEST(Hours, everyDayOfAYearIsOpenAsLongAsItsHoursSay) {
    const auto open = openMinutes(hoursOf(kDaily));
    ASSERT_EQ(open.size(), 365U);
    for (const auto& [day, minutes] : open) EXPECT_EQ(minutes, 480) << day;
}

// On 2026-03-29 the clock goes from 2 to 3, on 2026-10-25 from 3 back to 2.
TEST(Hours, overBothChangesOfSummerTimeTheClockOnTheWallCounts) {
    const auto open = openMinutes(hoursOf("open { days: [SUNDAY] from: \"01:00\" to: \"04:00\" }"));
    for (const auto& [day, minutes] : open)
        EXPECT_TRUE(minutes == 0 || minutes == 180 || day == "3-29" || day == "10-25") << day;
    EXPECT_EQ(open.at("3-29"), 120);
    EXPECT_EQ(open.at("10-25"), 240);
    EXPECT_EQ(open.at("3-22"), 180);
}

TEST(Hours, aSpanMayEndOnTheNextDayAlsoAcrossAChangeAndAMonth) {
    const auto open =
        openMinutes(hoursOf("open { days: [SATURDAY] from: \"22:00\" to: \"02:30\" }"));
    EXPECT_EQ(open.at("2-28"), 120);
    EXPECT_EQ(open.at("3-1"), 150);
    EXPECT_EQ(open.at("3-29"), 120) << "half past two does not come";
    EXPECT_EQ(open.at("10-25"), 180) << "it comes twice";
    EXPECT_EQ(open.at("3-2"), 0);
    const auto newYear =
        openMinutes(hoursOf("open { days: [WEDNESDAY] from: \"22:00\" to: \"02:30\" }"));
    EXPECT_EQ(newYear.at("1-1"), 150) << "since the last day of the year before";
}

// Whoever starts at whatever second, and however often, wants the same.
TEST(Hours, whatIsWantedDependsOnTheClockAloneAndChangesAtWholeMinutes) {
    const Hours hours = hoursOf(kDaily + "exceptions { date: \"2026-12-24\" }");
    std::mt19937 random(1);
    std::uniform_int_distribution<long long> second(0, 365 * kDay - 1);
    for (int i = 0; i < 2000; ++i) {
        const long long t = kNewYear2026 + second(random);
        EXPECT_EQ(at(hours, t), at(hours, t - t % kMinute)) << t;
        EXPECT_EQ(at(hours, t), at(hoursOf(kDaily + "exceptions { date: \"2026-12-24\" }"), t));
    }
    int changes = 0;
    for (long long t = kNewYear2026 + kMinute; t < kNewYear2026 + 365 * kDay; t += kMinute)
        if (at(hours, t) != at(hours, t - kMinute)) ++changes;
    EXPECT_EQ(changes, 2 * 364);
}

TEST(Hours, anExceptionStandsInPlaceOfItsDayAndTheLaterLineCounts) {
    const Hours hours =
        hoursOf(kDaily +
                "open { days: [FRIDAY] from: \"17:00\" to: \"22:00\" scene: \"night\" }\n"
                "exceptions { date: \"2026-12-24\" }\n"
                "exceptions { date: \"2026-12-25\" open { from: \"12:00\" to: \"14:00\" scene: "
                "\"snow\" } }");
    const long long noon = 1798110000;  // 2026-12-24 12:00 in Berlin
    EXPECT_FALSE(at(hours, noon).isOpen);
    EXPECT_EQ(at(hours, noon + kDay).scene, "snow");
    EXPECT_FALSE(at(hours, noon + kDay + 6 * kHour).isOpen) << "a Friday, but an exception";
    EXPECT_EQ(at(hours, noon - 6 * kDay).scene, "reef");
    EXPECT_EQ(at(hours, noon - 6 * kDay + 5 * kHour).scene, "night");
    EXPECT_EQ(at(hours, noon - 6 * kDay).quality, "high");
    EXPECT_EQ(at(hours, noon - 6 * kDay + 5 * kHour).quality, "");
}

TEST(Hours, theClockIsThatOfTheZone) {
    EXPECT_EQ(civilTime("UTC", 0).minute, 0);
    EXPECT_EQ(civilTime("Europe/Berlin", 0).minute, 60);
    EXPECT_EQ(civilTime("America/New_York", 0).day, 31);
    EXPECT_EQ(civilTime("UTC", 0).weekday, 4);
    EXPECT_EQ(civilTime("UTC", 3 * kDay).weekday, 7);
}

TEST(Hours, aMistakeIsNamedWithItsPlaceAndWhatToDo) {
    const std::array<std::pair<const char*, const char*>, 11> kMistakes{{
        {"open { days: [MONDAY] from: \"25:00\" to: \"18:00\" }",
         "2:23: from \"25:00\" is no time"},
        {"open { days: [MONDAY] from: \"10:00\" to: \"1800\" }", "is no time"},
        {"open { from: \"10:00\" to: \"18:00\" }", "say on which days"},
        {"open { days: [MONDAY] to: \"18:00\" }", "from"},
        {"open { days: [MONDAY] from: \"10:00\" to: \"18:00\" quality: \"best\" }", "low, medium"},
        {"exceptions { date: \"2026-13-01\" }", "2:14: date \"2026-13-01\" is no day"},
        {"exceptions { date: \"2026-02-30\" }", "is no day"},
        {"exceptions { date: \"2026-01-01\" }\nexceptions { date: \"2026-01-01\" }",
         "there already"},
        {"projectors { name: \"left\" address: \"left.local\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"192.168.7.21:99999\" }", "address is a number"},
        {"opne { }", "no field named"},
    }};
    for (const auto& [text, why] : kMistakes) {
        try {
            static_cast<void>(hoursOf(text));
            ADD_FAILURE() << text;
        } catch (const Error& problem) {
            const std::string said = problem.what();
            EXPECT_TRUE(said.starts_with("hours.txtpb:")) << said;
            EXPECT_NE(said.find(why), std::string::npos) << said;
        }
    }
    EXPECT_THROW(static_cast<void>(parseHours("zone: \"Nowhere\"", "x")), Error);
    EXPECT_THROW(static_cast<void>(parseHours("zone: \"../etc/passwd\"", "x")), Error);
    EXPECT_EQ(hoursOf("projectors { name: \"left\" address: \"192.168.7.21\" }").projectors[0].port,
              4352);
}

}  // namespace
}  // namespace aquarama::config
