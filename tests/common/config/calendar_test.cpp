// SPDX-License-Identifier: Apache-2.0
// Moments by the clock of a hall, and coming changes, over both changes of summer time.
#include "common/config/calendar.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kBerlin = "Europe/Berlin";
constexpr long long kHourSeconds = 3600, kDaySeconds = 86400;

Hours berlinHours(const std::string& rest) {
    return parseHours(std::string("zone: \"") + kBerlin + "\"\n" + rest, "hours.txtpb");
}

std::string refusalOf(const std::string& text) {
    try {
        static_cast<void>(momentOf(kBerlin, text));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// The changes after a moment, as a crew reads them.
std::vector<std::string> changesAfter(const Hours& hours,
                                      const std::string& text,
                                      std::size_t most) {
    std::vector<std::string> changes;
    long long after = momentOf(kBerlin, text);
    while (changes.size() < most) {
        const auto change = changeAfter(hours, after, 366);
        if (!change) break;
        changes.push_back(clockText(kBerlin, change->at) + ": " + textOf(change->wanted));
        after = change->at;
    }
    return changes;
}

TEST(Calendar, aTimeOfTheHallIsAMomentAndBack) {
    EXPECT_EQ(momentOf("UTC", "1970-01-02 00:01"), kDaySeconds + 60);
    EXPECT_EQ(momentOf(kBerlin, "2026-12-24 18:00"), momentOf("UTC", "2026-12-24 17:00"));
    EXPECT_EQ(momentOf(kBerlin, "2026-07-24 18:00"), momentOf("UTC", "2026-07-24 16:00"));
    EXPECT_EQ(momentOf("America/St_Johns", "2026-12-24 18:00"),
              momentOf("UTC", "2026-12-24 21:30"));
    EXPECT_EQ(clockText("America/St_Johns", momentOf("UTC", "2026-12-24 21:30")),
              "2026-12-24 18:00 -03:30 Thursday");
}

// Each hour of a year, in a zone of either half of the world, and one that moves by half an hour.
TEST(Calendar, eachHourThatIsShownIsFoundAgain) {
    for (const std::string zone : {"Europe/Berlin", "Australia/Lord_Howe", "America/New_York"})
        for (long long at = momentOf("UTC", "2026-01-01 00:00"), i = 0; i < 365 * 24; ++i) {
            const long long moment = at + i * kHourSeconds;
            const long long found = momentOf(zone, clockText(zone, moment).substr(0, 16));
            EXPECT_TRUE(found == moment || (found < moment && found >= moment - kHourSeconds &&
                                            clockText(zone, found).substr(0, 16) ==
                                                clockText(zone, moment).substr(0, 16)))
                << zone << " " << moment;
        }
}

TEST(Calendar, theFirstOfTwoTimesCountsAndOneThatDoesNotComeIsRefused) {
    EXPECT_EQ(clockText(kBerlin, momentOf(kBerlin, "2026-10-25 02:30")),
              "2026-10-25 02:30 +02:00 Sunday");
    EXPECT_EQ(refusalOf("2026-03-29 02:30"),
              "\"2026-03-29 02:30\" does not come in Europe/Berlin: the clock is put forward past "
              "it; give another time");
}

TEST(Calendar, whatIsNoTimeIsRefused) {
    for (const char* const text : {"",
                                   "2026-12-24",
                                   "2026-12-24 18",
                                   "2026-12-24 24:00",
                                   "2026-12-24 18:60",
                                   "2026-12-24T18:00",
                                   "2026-02-29 18:00",
                                   "2026-12-24 18:00:00",
                                   "24.12.2026 18:00"})
        EXPECT_THAT(refusalOf(text), HasSubstr("is no day and time")) << text;
}

TEST(Calendar, changesOverSummerTimeAreAtTheTimesOfTheHall) {
    const Hours hours = berlinHours(
        "open { days: [SATURDAY, SUNDAY] from: \"10:00\" to: \"18:00\" scene: \"reef\" }");
    EXPECT_THAT(changesAfter(hours, "2026-03-28 12:00", 3),
                ElementsAre("2026-03-28 18:00 +01:00 Saturday: closed",
                            "2026-03-29 10:00 +02:00 Sunday: open, scene reef",
                            "2026-03-29 18:00 +02:00 Sunday: closed"));
    EXPECT_THAT(changesAfter(hours, "2026-10-24 12:00", 2),
                ElementsAre("2026-10-24 18:00 +02:00 Saturday: closed",
                            "2026-10-25 10:00 +01:00 Sunday: open, scene reef"));
}

TEST(Calendar, aChangeIsTheFirstMinuteAtWhichSomethingElseIsWanted) {
    const Hours hours = berlinHours(
        "open { days: [MONDAY] from: \"10:00\" to: \"18:00\" scene: \"reef\" }"
        "open { days: [MONDAY] from: \"12:00\" to: \"13:00\" scene: \"reef\" quality: \"low\" }"
        "exceptions { date: \"2026-12-28\" }");
    const auto changes = changesAfter(hours, "2026-12-21 09:59", 5);
    EXPECT_THAT(changes,
                ElementsAre("2026-12-21 10:00 +01:00 Monday: open, scene reef",
                            "2026-12-21 12:00 +01:00 Monday: open, scene reef, quality low",
                            "2026-12-21 13:00 +01:00 Monday: open, scene reef",
                            "2026-12-21 18:00 +01:00 Monday: closed",
                            "2027-01-04 10:00 +01:00 Monday: open, scene reef"));
    const auto change = changeAfter(hours, momentOf(kBerlin, "2026-12-21 11:59"), 1);
    ASSERT_TRUE(change);
    EXPECT_EQ(wantedAt(hours, change->at), change->wanted);
    EXPECT_NE(wantedAt(hours, change->at - 1), change->wanted);
    EXPECT_FALSE(changeAfter(hours, momentOf(kBerlin, "2026-12-22 00:00"), 5));
    EXPECT_FALSE(changeAfter(berlinHours(""), 0, 30));
}

TEST(Calendar, eachSceneOfSpansAndExceptionsIsNamedOnce) {
    EXPECT_THAT(scenesOf(berlinHours(
                    "open { days: [MONDAY] from: \"10:00\" to: \"12:00\" scene: \"reef\" }"
                    "open { days: [SUNDAY] from: \"10:00\" to: \"12:00\" scene: \"reef\" }"
                    "open { days: [FRIDAY] from: \"10:00\" to: \"12:00\" }"
                    "exceptions { date: \"2026-12-24\" open { from: \"10:00\" to: \"12:00\" "
                    "scene: \"ball\" } }")),
                ElementsAre("ball", "reef"));
}

}  // namespace
}  // namespace aquarama::config
