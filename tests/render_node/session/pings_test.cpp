// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/pings.h"

#include <chrono>

#include <gtest/gtest.h>

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr net::Moment kStart{seconds(10)};

v1::Pong pongTo(net::Moment sent, net::Moment master) {
    v1::Pong pong;
    pong.set_sent_ns(sent.time_since_epoch().count());
    pong.set_master_ns(master.time_since_epoch().count());
    return pong;
}

TEST(Pings, areSentTwentyTimesASecond) {
    Pings pings;
    int sent = 0;
    for (net::Moment now = kStart; now < kStart + seconds(1); now += milliseconds(1))
        if (pings.due(now)) ++sent;
    EXPECT_EQ(sent, 20);
}

TEST(Pings, tellTheMastersClockFromHalfTheRoundTrip) {
    Pings pings;
    EXPECT_FALSE(pings.offset(kStart));
    ASSERT_TRUE(pings.due(kStart));
    const net::Moment back = kStart + milliseconds(8);
    pings.hear(pongTo(kStart, kStart + seconds(60) + milliseconds(4)), back);
    EXPECT_EQ(pings.offset(back), net::Duration{seconds(60)});
}

// Four pings of which three are answered, after 2, 2 and 8 ms.
TEST(Pings, reportRoundTripsJitterAndWhatWasNotAnswered) {
    Pings pings;
    net::Moment now = kStart;
    for (const int answer : {2, 2, 8, 0}) {
        const auto ping = pings.due(now);
        ASSERT_TRUE(ping);
        const net::Moment sent{net::Duration{ping->ping().sent_ns()}};
        if (answer > 0) pings.hear(pongTo(sent, sent), sent + milliseconds(answer));
        now += milliseconds(50);
    }
    v1::NodeReport report;
    pings.report(report, kStart + seconds(2));
    EXPECT_FLOAT_EQ(report.round_trip_median_ms(), 2);
    EXPECT_FLOAT_EQ(report.jitter_ms(), 3);
    EXPECT_FLOAT_EQ(report.unanswered_percent(), 25);
}

TEST(Pings, aPingIsUnansweredOnlyAfterASecond) {
    Pings pings;
    ASSERT_TRUE(pings.due(kStart));
    v1::NodeReport report;
    pings.report(report, kStart + milliseconds(900));
    EXPECT_FLOAT_EQ(report.unanswered_percent(), 0);
}

}  // namespace
}  // namespace aquarama::session
