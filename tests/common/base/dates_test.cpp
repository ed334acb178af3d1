// SPDX-License-Identifier: Apache-2.0
#include "common/base/dates.h"

#include <gtest/gtest.h>

#include "common/base/counted.h"

namespace aquarama {
namespace {

constexpr double kBuilt = 1795590000;  // 2026-11-25

TEST(Dates, aClockBeforeTheBuildIsNamedWithBothDays) {
    EXPECT_EQ(clockDoubt(0, kBuilt),
              "the clock of this machine says 1970-01-01, before this program was built "
              "(2026-11-25)");
    EXPECT_NE(clockDoubt(-5, kBuilt), "");
    EXPECT_NE(clockDoubt(kBuilt - 1.1 * kSecondsOfDay, kBuilt), "");
    for (const double now : {kBuilt - kSecondsOfDay / 2, kBuilt, kBuilt + 1e9})
        EXPECT_EQ(clockDoubt(now, kBuilt), "") << now;
    EXPECT_EQ(clockDoubt(0, 0), "") << "the build knew no day";
}

TEST(Dates, daysAreReadAsTheyAreWritten) {
    for (const char* const day : {"1970-01-01", "2024-02-29", "2026-11-25", "2106-02-08"})
        EXPECT_EQ(dayOf(secondsOfDay(day).value()), day);
    EXPECT_EQ(secondsOfDay("1970-01-02"), kSecondsOfDay);
    for (const char* const none : {"", "today", "2026-13-01", "2026-11-25 noon", "25.11.2026"})
        EXPECT_FALSE(secondsOfDay(none)) << none;
}

TEST(Dates, theEndOfACertificateIsSaidWeeksBefore) {
    const Validity validity{kBuilt, kBuilt + 397 * kSecondsOfDay};
    const auto said = [&](double daysLeft) -> std::string {
        const auto concern = concernAbout(validity, validity.until - daysLeft * kSecondsOfDay, 30);
        return concern ? (concern->isUrgent ? "! " : "") + concern->what : "";
    };
    EXPECT_EQ(said(31), "");
    EXPECT_EQ(said(29.5), "runs out on 2027-12-27, in 29 days");
    EXPECT_EQ(said(6.5), "! runs out on 2027-12-27, in 6 days");
    EXPECT_EQ(said(1.5), "! runs out on 2027-12-27, in 1 day");
    EXPECT_EQ(said(0.5), "! runs out on 2027-12-27, within a day");
    EXPECT_EQ(said(-1), "! ran out on 2027-12-27");
    EXPECT_EQ(said(400),
              "! is not valid before 2026-11-25, and the clock of this machine says "
              "2026-11-22");
}

TEST(Dates, oneThingHasNoPlural) {
    EXPECT_EQ(counted(1, "node"), "1 node");
    EXPECT_EQ(counted(0, "node"), "0 nodes");
    EXPECT_EQ(counted(12, "node"), "12 nodes");
}

}  // namespace
}  // namespace aquarama
