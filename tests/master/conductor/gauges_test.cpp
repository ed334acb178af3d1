// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/gauges.h"

#include <chrono>

#include <gtest/gtest.h>

#include "tests/master/conductor/parts.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Of a desk, without a port for Prometheus.
class DeskGauges : public testing::Test {
  protected:
    v1::StatusReply status() {
        v1::StatusReply reply;
        gauges.writeStatus(reply, report, parts.roster, barrier);
        return reply;
    }
    bool count(net::Moment now) {
        return gauges.count(now, report, 3, false, parts.roster, barrier);
    }

    test::Parts parts;
    ShowReport report;
    PresentBarrier barrier{3, {}, test::kStart};
    Gauges gauges{parts.roster, 0};
};

TEST_F(DeskGauges, theStatusHasTheConditionOfEachNode) {
    parts.join("left");
    barrier.join(0, Frame{0});
    barrier.begin(Frame{0});
    parts.join("middle").prepared = false;
    parts.seat("right").dropped = 2;
    parts.seat("right").machine = "east";
    const v1::StatusReply reply = status();
    ASSERT_EQ(reply.nodes_size(), 3);
    EXPECT_EQ(reply.nodes(0).condition(), v1::NODE_IN_STEP);
    EXPECT_EQ(reply.nodes(1).condition(), v1::NODE_PREPARING);
    EXPECT_EQ(reply.nodes(2).condition(), v1::NODE_ABSENT);
    EXPECT_EQ(reply.nodes(2).dropped(), 2U);
    EXPECT_EQ(reply.nodes(2).machine(), "east");
}

TEST_F(DeskGauges, aNodeThatMissedADeadlineIsLate) {
    for (const char* name : {"left", "middle"}) parts.join(name);
    for (const std::size_t node : {0, 1}) barrier.join(node, Frame{0});
    barrier.begin(Frame{0});
    barrier.ready(0, Frame{0}, test::kStart);
    static_cast<void>(barrier.decide(test::kStart));
    static_cast<void>(barrier.decide(test::kStart + seconds(1)));
    EXPECT_EQ(status().nodes(0).condition(), v1::NODE_IN_STEP);
    EXPECT_EQ(status().nodes(1).condition(), v1::NODE_LATE);
    EXPECT_EQ(status().nodes(1).late(), 1U);
}

TEST_F(DeskGauges, framesAreMeasuredByTheirReleases) {
    for (int frame = 0; frame < 9; ++frame)
        gauges.released(test::kStart, frame == 0 ? milliseconds(50) : milliseconds(10));
    EXPECT_FLOAT_EQ(status().frame_median_ms(), 10);
    EXPECT_FLOAT_EQ(status().frame_peak_ms(), 50);
}

// The skew of a frame is known when the reports of later frames have come.
TEST_F(DeskGauges, theSkewIsBetweenTheFirstAndTheLastNodeOfAFrame) {
    for (std::uint64_t frame = 0; frame < 20; ++frame)
        for (const std::int64_t lateNs : {0, 150'000})
            gauges.nodeReleased(
                test::kStart, {frame}, net::Moment{std::chrono::nanoseconds{1'000'000 + lateNs}});
    EXPECT_NEAR(status().skew_median_ms(), 0.15, 1e-6);
    EXPECT_NEAR(status().skew_peak_ms(), 0.15, 1e-6);
    EXPECT_GT(status().skew_counts(2), 0U) << "up to 0.2 ms";
    EXPECT_EQ(status().skew_counts(1), 0U) << "up to 0.1 ms";
}

TEST_F(DeskGauges, theSpeedFollowsFromTwoStates) {
    wire::StateView state{};
    state.tick = Tick{1};
    gauges.published(state, 100);
    state.tick = Tick{31};
    state.eye.positionMetres = {0, 0, -2};
    gauges.published(state, 100);
    EXPECT_FLOAT_EQ(status().speed_m_s(), 4) << "2 m in 30 of 60 ticks a second";
    EXPECT_EQ(gauges.eye().positionMetres.z, -2);
    gauges.published(state, 100);
    EXPECT_FLOAT_EQ(status().speed_m_s(), 0) << "the same moment again";
}

TEST_F(DeskGauges, figuresAreCountedOnceASecond) {
    EXPECT_TRUE(count(test::kStart));
    EXPECT_FALSE(count(test::kStart + milliseconds(999)));
    EXPECT_TRUE(count(test::kStart + milliseconds(1000)));
}

// The service manager restarts a master whose world hangs.
TEST(Watchdog, aShowIsAliveAsLongAsTicksCome) {
    Watchdog watchdog;
    net::Moment now = test::kStart;
    for (std::uint64_t tick = 0; tick < 5; ++tick, now += seconds(1))
        EXPECT_TRUE(watchdog.isAlive(now, Tick{tick}, false));
    EXPECT_FALSE(watchdog.isAlive(now + seconds(1), Tick{4}, false));
    EXPECT_TRUE(watchdog.isAlive(now + seconds(2), Tick{5}, false)) << "it goes on";
}

TEST(Watchdog, aWorldThatStandsStillNeedsNoTicks) {
    Watchdog watchdog;
    EXPECT_TRUE(watchdog.isAlive(test::kStart, Tick{7}, true));
    EXPECT_TRUE(watchdog.isAlive(test::kStart + seconds(60), Tick{7}, true));
    EXPECT_TRUE(watchdog.isAlive(test::kStart + seconds(61), Tick{7}, false));
    EXPECT_FALSE(watchdog.isAlive(test::kStart + seconds(63), Tick{7}, false));
}

// The watchdog of a hung first tick: no tick has come at all.
TEST(Watchdog, aWorldWithoutItsFirstTickIsNotAlive) {
    Watchdog watchdog;
    EXPECT_FALSE(watchdog.isAlive(test::kStart, std::nullopt, false));
}

}  // namespace
}  // namespace aquarama::conductor
