// SPDX-License-Identifier: Apache-2.0
#include "common/net/clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <thread>
#include <type_traits>

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

namespace aquarama::net {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// Where one is taken for the other, the build fails.
static_assert(!std::is_convertible_v<Duration, Moment> && !std::is_convertible_v<Moment, Duration>);

TEST(ClockOffset, isUnknownBeforeTheFirstRoundTrip) {
    EXPECT_FALSE(ClockOffset{}.offset({}));
}

TEST(ClockOffset, isExactWhereBothWaysTakeEquallyLong) {
    ClockOffset clock;
    clock.add(Moment{milliseconds(100)}, Moment{milliseconds(5103)}, Moment{milliseconds(106)});
    EXPECT_EQ(clock.offset(Moment{milliseconds(106)}), milliseconds(5000));
    EXPECT_EQ(clock.roundTrip(), milliseconds(6));
}

TEST(ClockOffset, isWithinHalfTheShortestRoundTripHoweverBusyTheWay) {
    std::mt19937 random(5);
    const Duration truth = milliseconds(-123456);
    const Duration shortest = microseconds(80);
    ClockOffset clock;
    Moment now{milliseconds(1000)};
    for (int ping = 0; ping < 40; ++ping) {
        const auto queued = [&] { return microseconds(ping == 17 ? 0 : random() % 20000); };
        const Moment there = now + shortest / 2 + queued();
        const Moment back = there + shortest / 2 + queued();
        clock.add(now, there + truth, back);
        now += milliseconds(50);
    }
    const Duration error = *clock.offset(now) - truth;
    EXPECT_LE(std::abs(error.count()), (*clock.roundTrip() / 2).count());
    EXPECT_EQ(clock.roundTrip(), shortest);
}

TEST(ClockOffset, followsAClockThatDriftsByForgetting) {
    ClockOffset clock;
    // By far the best, but old.
    clock.add({}, {}, Moment{microseconds(10)});
    for (int ping = 1; ping <= 64; ++ping) {
        const Moment now{milliseconds(50 * ping)};
        clock.add(now, now + microseconds(500 + 200), now + microseconds(400));
    }
    EXPECT_EQ(clock.offset(Moment{milliseconds(3200)}), microseconds(500));
}

// Two crystals 80 ppm apart, over a way on which every packet queues for up to 2 ms: 80 ppm are
// 0.24 ms in the three seconds of the best sample.
TEST(ClockOffset, followsADriftingClockToATenthOfAMillisecond) {
    constexpr double kDrift = 80e-6;
    std::mt19937 random(7);
    ClockOffset clock;
    const auto truthAt = [&](Moment now) {
        return milliseconds(-777) +
               std::chrono::duration_cast<Duration>(kDrift * now.time_since_epoch());
    };
    double worst = 0;
    Moment now{std::chrono::seconds(5)};
    for (int ping = 0; ping < 60 * 20; ++ping) {
        const auto queued = [&] { return microseconds(random() % 2000); };
        const Moment there = now + microseconds(40) + queued();
        const Moment back = there + microseconds(40) + queued();
        clock.add(now, there + truthAt(there), back);
        now += milliseconds(50);
        if (ping < 20 * 20) continue;  // from the twentieth second on
        const Duration error = *clock.offset(now) - truthAt(now);
        worst = std::max(worst, std::abs(static_cast<double>(error.count())) * 1e-6);
    }
    EXPECT_LT(worst, 0.1) << "milliseconds";
    EXPECT_NEAR(clock.driftPpm(), 80, 10);
}

TEST(ClockOffset, ignoresAnEchoFromTheFuture) {
    ClockOffset clock;
    clock.add(Moment{milliseconds(10)}, Moment{milliseconds(1)}, Moment{milliseconds(9)});
    EXPECT_FALSE(clock.offset(Moment{milliseconds(10)}));
}

// Blanks are dated to 0.1 ms, and not all are seen.
// libzmq's threads set again the policy that the C library tells them, and end the program where
// the kernel refuses it: so the library must not remember what the kernel has reset for them.
TEST(RealTime, isNoneOfThreadsThatAreStartedLaterAndTheLibraryKnows) {
    bool isGranted = false;
    int told = -1, real = -1, setAgain = -1;
    std::thread([&] {
        isGranted = runInRealTime();
        std::thread([&] {
            sched_param priority{};
            pthread_getschedparam(pthread_self(), &told, &priority);
            real = sched_getscheduler(0);
            setAgain = pthread_setschedparam(pthread_self(), told, &priority);
        }).join();
    }).join();
    EXPECT_EQ(real, SCHED_OTHER);
    EXPECT_EQ(told, SCHED_OTHER);
    EXPECT_EQ(setAgain, 0);
    if (!isGranted) GTEST_SKIP() << "this user may not run threads in real time";
}

TEST(RecentTimes, areCountedUpToEachEdgeAndAboveAll) {
    using std::chrono::milliseconds;
    RecentTimes times;
    for (const int ms : {0, 1, 1, 2, 3, 10}) times.add(milliseconds(ms));
    const std::array<Duration, 2> edges{milliseconds(1), milliseconds(3)};
    EXPECT_EQ(times.countsUpTo(edges), (std::vector<std::uint32_t>{3, 2, 1}));
}

TEST(RecentPeak, isTheLongestOfThisTenthOfASecondAndTheOneBefore) {
    using std::chrono::milliseconds;
    RecentPeak peak;
    EXPECT_EQ(peak.ms(), 0);
    peak.add(Moment{milliseconds(1000)}, milliseconds(17));
    peak.add(Moment{milliseconds(1017)}, milliseconds(90));
    peak.add(Moment{milliseconds(1034)}, milliseconds(16));
    EXPECT_EQ(peak.ms(), 90);
    peak.add(Moment{milliseconds(1120)}, milliseconds(18));
    EXPECT_EQ(peak.ms(), 90) << "whoever asks now has not heard of it";
    peak.add(Moment{milliseconds(1220)}, milliseconds(15));
    EXPECT_EQ(peak.ms(), 18);
}

TEST(BlankMeter, findsThePeriodOfADisplay) {
    std::mt19937 random(7);
    BlankMeter meter;
    const Duration period{16'683'350};
    for (std::uint64_t count = 1000; count < 1400; count += 1 + random() % 30)
        meter.add(count, Moment{period * count + microseconds(random() % 100)});
    ASSERT_TRUE(meter.blanks());
    EXPECT_NEAR(static_cast<double>(meter.blanks()->period.count()), 16'683'350, 500);
}

TEST(BlankMeter, knowsNothingForASecondAndAfterAJump) {
    BlankMeter meter;
    const Duration period = milliseconds(16);
    for (std::uint64_t count = 1; count <= 60; ++count) meter.add(count, Moment{period * count});
    EXPECT_FALSE(meter.blanks());
    meter.add(80, Moment{period * 80});
    EXPECT_TRUE(meter.blanks());
    meter.add(20, Moment{period * 81});  // another display
    EXPECT_FALSE(meter.blanks());
    meter.add(1000000, Moment{period * 82});  // a driver that counts nonsense
    EXPECT_FALSE(meter.blanks());
}

}  // namespace
}  // namespace aquarama::net
