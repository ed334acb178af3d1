// SPDX-License-Identifier: Apache-2.0
#include "common/net/clock.h"

#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

namespace aquarama::net {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(ClockOffset, isUnknownBeforeTheFirstRoundTrip) {
    EXPECT_FALSE(ClockOffset{}.offset());
}

TEST(ClockOffset, isExactWhereBothWaysTakeEquallyLong) {
    ClockOffset clock;
    clock.add(milliseconds(100), milliseconds(5103), milliseconds(106));
    EXPECT_EQ(clock.offset(), milliseconds(5000));
    EXPECT_EQ(clock.roundTrip(), milliseconds(6));
}

TEST(ClockOffset, isWithinHalfTheShortestRoundTripHoweverBusyTheWay) {
    std::mt19937 random(5);
    const Instant truth = milliseconds(-123456);
    const Instant shortest = microseconds(80);
    ClockOffset clock;
    Instant now = milliseconds(1000);
    for (int ping = 0; ping < 40; ++ping) {
        const auto queued = [&] { return microseconds(ping == 17 ? 0 : random() % 20000); };
        const Instant there = now + shortest / 2 + queued();
        const Instant back = there + shortest / 2 + queued();
        clock.add(now, there + truth, back);
        now += milliseconds(50);
    }
    const Instant error = *clock.offset() - truth;
    EXPECT_LE(std::abs(error.count()), (*clock.roundTrip() / 2).count());
    EXPECT_EQ(clock.roundTrip(), shortest);
}

TEST(ClockOffset, followsAClockThatDriftsByForgetting) {
    ClockOffset clock;
    clock.add(milliseconds(0), milliseconds(0), microseconds(10));  // by far the best, but old
    for (int ping = 1; ping <= 64; ++ping) {
        const Instant now = milliseconds(50 * ping);
        clock.add(now, now + microseconds(500 + 200), now + microseconds(400));
    }
    EXPECT_EQ(clock.offset(), microseconds(500));
}

TEST(ClockOffset, ignoresAnEchoFromTheFuture) {
    ClockOffset clock;
    clock.add(milliseconds(10), milliseconds(1), milliseconds(9));
    EXPECT_FALSE(clock.offset());
}

}  // namespace
}  // namespace aquarama::net
