// SPDX-License-Identifier: Apache-2.0
#include "common/config/hours.h"

#include <array>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/config/text_file.h"

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
    return wantedAt(hours, unixSeconds);
}

// How many minutes of each local day of the year it is open, by "month-day".
std::map<std::string, int> openMinutes(const Hours& hours) {
    std::map<std::string, int> open;
    for (long long t = kNewYear2026; t < kNewYear2026 + 365 * kDay; t += kMinute) {
        const CivilTime civil = civilTime(hours.zone, t);
        int& minutes = open[std::to_string(civil.month) + "-" + std::to_string(civil.day)];
        if (at(hours, t).isOpen) ++minutes;
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
    EXPECT_EQ(open.at("10-25"), 150) << "it comes twice, and counts when it first comes";
    EXPECT_EQ(open.at("3-2"), 0);
    const auto newYear =
        openMinutes(hoursOf("open { days: [WEDNESDAY] from: \"22:00\" to: \"02:30\" }"));
    EXPECT_EQ(newYear.at("1-1"), 150) << "since the last day of the year before";
}

// When the wall opens and closes by the clocks of the hall, "03:00 opens", over a night of Unix
// time. A time that comes twice is followed by a second letter.
std::string nightOf(const std::string& zone, const std::string& span, long long from) {
    const std::string days =
        "days: [MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SATURDAY, SUNDAY]";
    const Hours hours =
        parseHours("zone: \"" + zone + "\" open { " + days + " " + span + " }", "hours.txtpb");
    std::string said;
    std::map<int, int> times;
    for (long long t = from; t < from + 8 * kHour; t += kMinute) {
        const int minute = civilTime(zone, t).minute;
        const bool isSecond = times[minute]++ > 0;
        if (at(hours, t).isOpen == at(hours, t - kMinute).isOpen) continue;
        char clock[16];
        snprintf(clock, sizeof clock, "%02d:%02d", minute / 60, minute % 60);
        said += std::string(said.empty() ? "" : " ") + clock + (isSecond ? "b" : "") +
                (at(hours, t).isOpen ? " opens" : " closes");
    }
    return said;
}

// The nights in which clocks are changed, from 22:00 of the day before (UTC).
struct Change {
    const char* zone;
    long long forward, back;  // Unix time of the night's beginning
};

// From, to; and what comes of it in an ordinary night, when clocks go forward, and when they go
// back.
struct Outcome {
    const char *span, *ordinary, *forward, *back;
};

void expectOutcomes(const Change& change, const std::vector<Outcome>& outcomes) {
    for (const auto& [span, ordinary, forward, back] : outcomes) {
        EXPECT_EQ(nightOf(change.zone, span, change.forward - 3 * kDay), ordinary)
            << change.zone << ", an ordinary night: " << span;
        EXPECT_EQ(nightOf(change.zone, span, change.forward), forward)
            << change.zone << ", clocks go forward: " << span;
        EXPECT_EQ(nightOf(change.zone, span, change.back), back)
            << change.zone << ", clocks go back: " << span;
    }
}

// What each span of a table comes to where 02:00 to 03:00 is left out, or comes twice.
const std::vector<Outcome> kWholeHour{
    {"from: \"00:30\" to: \"05:00\"",
     "00:30 opens 05:00 closes",
     "00:30 opens 05:00 closes",
     "00:30 opens 05:00 closes"},
    // Ends in it.
    {"from: \"01:00\" to: \"02:30\"",
     "01:00 opens 02:30 closes",
     "01:00 opens 03:00 closes",
     "01:00 opens 02:30 closes"},
    {"from: \"01:00\" to: \"02:00\"",
     "01:00 opens 02:00 closes",
     "01:00 opens 03:00 closes",
     "01:00 opens 02:00 closes"},
    {"from: \"01:00\" to: \"03:00\"",
     "01:00 opens 03:00 closes",
     "01:00 opens 03:00 closes",
     "01:00 opens 03:00 closes"},
    // Begins in it.
    {"from: \"02:30\" to: \"04:00\"",
     "02:30 opens 04:00 closes",
     "03:00 opens 04:00 closes",
     "02:30 opens 04:00 closes"},
    {"from: \"02:00\" to: \"04:00\"",
     "02:00 opens 04:00 closes",
     "03:00 opens 04:00 closes",
     "02:00 opens 04:00 closes"},
    {"from: \"03:00\" to: \"04:00\"",
     "03:00 opens 04:00 closes",
     "03:00 opens 04:00 closes",
     "03:00 opens 04:00 closes"},
    // Lies wholly in it: an hour later.
    {"from: \"02:10\" to: \"02:40\"",
     "02:10 opens 02:40 closes",
     "03:10 opens 03:40 closes",
     "02:10 opens 02:40 closes"},
    {"from: \"02:00\" to: \"03:00\"",
     "02:00 opens 03:00 closes",
     "03:00 opens 04:00 closes",
     "02:00 opens 03:00 closes"},
};

// Moments of the tz database: Berlin 2026-03-29 and 10-25 at 01:00 UTC; New York 2026-03-08 at
// 07:00 and 11-01 at 06:00 UTC; Sydney 2026-10-04 and 04-05 (2026-10-03, 04-04 16:00 UTC).
TEST(Hours, overBothChangesOfSummerTimeNoOpeningOrClosingIsLostOrDoubled) {
    expectOutcomes({"Europe/Berlin", 1774735200, 1792879200}, kWholeHour);
    expectOutcomes({"Australia/Sydney", 1791028800, 1775304000}, kWholeHour);
    // Its clock goes back at 02:00 to 01:00, so another hour comes twice.
    std::vector<Outcome> newYork = kWholeHour;
    newYork.push_back({"from: \"01:30\" to: \"01:45\"",
                       "01:30 opens 01:45 closes",
                       "01:30 opens 01:45 closes",
                       "01:30 opens 01:45 closes"});
    newYork.push_back({"from: \"01:30\" to: \"04:00\"",
                       "01:30 opens 04:00 closes",
                       "01:30 opens 04:00 closes",
                       "01:30 opens 04:00 closes"});
    newYork.push_back({"from: \"00:30\" to: \"01:15\"",
                       "00:30 opens 01:15 closes",
                       "00:30 opens 01:15 closes",
                       "00:30 opens 01:15 closes"});
    expectOutcomes({"America/New_York", 1772942400, 1793505600}, newYork);
}

// By half an hour: 02:00 becomes 02:30, and 02:00 becomes 01:30.
TEST(Hours, aChangeOfHalfAnHourIsFollowedToo) {
    expectOutcomes({"Australia/Lord_Howe", 1791027000, 1775302200},
                   {{"from: \"02:05\" to: \"02:20\"",
                     "02:05 opens 02:20 closes",
                     "02:35 opens 02:50 closes",
                     "02:05 opens 02:20 closes"},
                    {"from: \"01:40\" to: \"01:50\"",
                     "01:40 opens 01:50 closes",
                     "01:40 opens 01:50 closes",
                     "01:40 opens 01:50 closes"},
                    {"from: \"01:45\" to: \"03:00\"",
                     "01:45 opens 03:00 closes",
                     "01:45 opens 03:00 closes",
                     "01:45 opens 03:00 closes"},
                    {"from: \"01:00\" to: \"02:10\"",
                     "01:00 opens 02:10 closes",
                     "01:00 opens 02:30 closes",
                     "01:00 opens 02:10 closes"}});
}

// In Santiago the clock goes forward at midnight: the day begins at 01:00.
TEST(Hours, aDayWithoutMidnightHasItsHours) {
    constexpr long long kNight = 1788658200;  // 2026-09-06 01:30 UTC
    const auto night = [&](const char* span) { return nightOf("America/Santiago", span, kNight); };
    EXPECT_EQ(night("from: \"22:00\" to: \"24:00\""), "22:00 opens 01:00 closes");
    EXPECT_EQ(night("from: \"00:10\" to: \"00:40\""), "01:10 opens 01:40 closes");
    EXPECT_EQ(night("from: \"00:30\" to: \"02:00\""), "01:00 opens 02:00 closes");
}

// Each minute of a year: as often as there are days.
TEST(Hours, inAYearEachSpanOpensAndClosesOnceADay) {
    for (const char* const zone : {"Europe/Berlin", "America/New_York", "Australia/Lord_Howe"}) {
        const std::string days =
            "days: [MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SATURDAY, SUNDAY]";
        const Hours hours = parseHours("zone: \"" + std::string(zone) + "\" open { " + days +
                                           " from: \"01:40\" to: \"02:20\" }",
                                       "hours.txtpb");
        int openings = 0;
        bool wasOpen = at(hours, kNewYear2026).isOpen;
        for (long long t = kNewYear2026; t < kNewYear2026 + 365 * kDay; t += 5 * kMinute) {
            const bool isOpen = at(hours, t).isOpen;
            if (isOpen && !wasOpen) ++openings;
            wasOpen = isOpen;
        }
        EXPECT_EQ(openings, 365) << zone;
    }
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
    const std::array<std::pair<const char*, const char*>, 33> kMistakes{{
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
        {"projectors { name: \"left\" address: \"left.local\" }",
         "2:27: address is a number of one machine"},
        {"projectors { name: \"left\" address: \"192.168.7.300\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"192.168.7\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"192.168.007.021\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"0.0.0.0\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"255.255.255.255\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"224.0.0.1\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"fe80::1\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"[fd00::21\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"::\" }", "address is a number"},
        {"projectors { name: \"left\" address: \" 192.168.7.21\" }", "address is a number"},
        {"projectors { name: \"left\" address: \"192.168.7.21:99999\" }", "its port is 1 to 65535"},
        {"projectors { name: \"left\" address: \"192.168.7.21:0\" }", "its port is 1 to 65535"},
        {"projectors { name: \"left\" address: \"192.168.7.21:\" }", "its port is 1 to 65535"},
        {"projectors { name: \"left\" address: \"[fd00::21]4352\" }", "its port is 1 to 65535"},
        {"projectors { name: \"left\" address: \"[fd00::21]:x\" }", "its port is 1 to 65535"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" password: "
         "\"123456789012345678901234567890123\" }",
         "2:47: a password of PJLink has at most 32 letters"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" password: \"schl\303\274ssel\" }",
         "letters without accents"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" password: \"a\\nb\" }",
         "2:47: password has U+000A (a control character): remove it"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" input: \"HDMI1\" }",
         "2:47: input \"HDMI1\" is no code of PJLink"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" input: \"30\" }", "no code of PJLink"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" }\n"
         "projectors { name: \"right\" address: \"10.0.0.1:4352\" }",
         "3:28: projector left has that address already"},
        {"projectors { name: \"left\" address: \"fd00::1\" }\n"
         "projectors { name: \"right\" address: \"[FD00:0::1]:4352\" }",
         "projector left has that address already"},
        {"projectors { name: \"left\" address: \"10.0.0.1\" }\n"
         "projectors { name: \"left\" address: \"10.0.0.2\" }",
         "3:14: there is a projector of that name already"},
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
}

// The mistakes of a text as "field: what is wrong", in order.
std::vector<std::string> mistakesIn(const std::string& text) {
    std::vector<std::string> list;
    try {
        static_cast<void>(parseHours(text, "hours.txtpb"));
    } catch (const FileError& error) {
        EXPECT_TRUE(std::string(error.what()).ends_with(error.mistakes.front().why));
        for (const FileMistake& mistake : error.mistakes)
            list.push_back(mistake.field + ": " + mistake.why);
    }
    return list;
}

TEST(Hours, everyMistakeThatTheSchemaKnowsNamesItsField) {
    EXPECT_THAT(mistakesIn(R"(
        open { days: [MONDAY, WEEKDAY_UNSPECIFIED] from: "" to: "18:00" }
        open { days: [MONDAY, MONDAY, MONDAY, MONDAY, MONDAY, MONDAY, MONDAY, MONDAY] from: "1" }
        exceptions { date: "2026-12-24" }
        exceptions { open { from: "10:00" to: "11:00" } open { from: "10:00" scene: "" } }
        projectors { name: "left" })"),
                testing::ElementsAre(testing::StartsWith("zone: the file lacks zone"),
                                     testing::StartsWith("open.0.days: days is WEEKDAY"),
                                     "open.0.from: from is empty: fill it in",
                                     testing::StartsWith("open.1.days: open has 8 days"),
                                     "open.1.to: open lacks to: add it",
                                     "exceptions.1.date: exceptions lacks date: add it",
                                     "exceptions.1.open.1.to: open lacks to: add it",
                                     "exceptions.1.open.1.scene: scene is empty: fill it in",
                                     "projectors.0.address: projectors lacks address: add it"));
}

TEST(Hours, everyMistakeInAValueNamesItsField) {
    EXPECT_THAT(mistakesIn(R"(zone: "Nowhere"
        open { from: "10:00" to: "18:00" }
        open { days: [MONDAY] from: "10:00" to: "25:00" }
        open { days: [MONDAY] from: "10:00" to: "18:00" quality: "best" }
        exceptions { date: "2026-12-24" open { days: [MONDAY] from: "10:00" to: "18:00" } }
        exceptions { date: "2026-12-25" open { from: "1000" to: "18:00" } }
        exceptions { date: "2026-12-26" }
        exceptions { date: "2026-12-26" }
        exceptions { date: "2026-13-01" }
        projectors { name: "left" address: "10.0.0.1" }
        projectors { name: "left" address: "10.0.0.2" }
        projectors { name: "right" address: "10.0.0.1:4352" }
        projectors { name: "top" address: "top.local" }
        projectors { name: "top" address: "10.0.0.3" input: "HDMI" })"),
                testing::ElementsAre(testing::StartsWith("zone: zone \"Nowhere\" is none"),
                                     testing::StartsWith("open.0.days: say on which days"),
                                     testing::StartsWith("open.1.to: to \"25:00\" is no time"),
                                     testing::StartsWith("open.2.quality: quality is low"),
                                     testing::StartsWith("exceptions.0.open.0.days: an exception"),
                                     testing::StartsWith("exceptions.1.open.0.from: from \"1000\""),
                                     testing::StartsWith("exceptions.3.date: the day is there"),
                                     testing::StartsWith("exceptions.4.date: date \"2026-13-01\""),
                                     testing::StartsWith("projectors.1.name: there is a projector"),
                                     testing::StartsWith("projectors.2.address: projector left"),
                                     testing::StartsWith("projectors.3.address: address is a"),
                                     testing::StartsWith("projectors.4.input: input \"HDMI\"")));
}

TEST(Hours, addressesAndInputsOfProjectorsAreRead) {
    const auto read = [](const std::string& address, const std::string& more = "") {
        const Hours hours =
            hoursOf("projectors { name: \"left\" address: \"" + address + "\" " + more + " }");
        return addressOf(hours.projectors[0]) + " " + hours.projectors[0].input;
    };
    EXPECT_EQ(read("192.168.7.21"), "192.168.7.21:4352 ");
    EXPECT_EQ(read("192.168.7.21:80", "input: \"31\""), "192.168.7.21:80 31");
    EXPECT_EQ(read("FD00:0::21"), "[fd00::21]:4352 ");
    EXPECT_EQ(read("[fd00::21]"), "[fd00::21]:4352 ");
    EXPECT_EQ(read("[fd00::21]:65535", "input: \"3a\""), "[fd00::21]:65535 3A");
}

}  // namespace
}  // namespace aquarama::config
