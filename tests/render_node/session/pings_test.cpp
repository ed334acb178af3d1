// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/pings.h"

#include <chrono>

#include <gtest/gtest.h>

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

v1::Pong pongTo(net::Moment sent, net::Moment master) {
    v1::Pong pong;
    pong.set_sent_ns(sent.count());
    pong.set_master_ns(master.count());
    return pong;
}

TEST(Pings, areSentTwentyTimesASecond) {
    Pings pings;
    int sent = 0;
    for (net::Moment now = seconds(10); now < seconds(11); now += milliseconds(1))
        if (pings.due(now)) ++sent;
    EXPECT_EQ(sent, 20);
}

TEST(Pings, tellTheMastersClockFromHalfTheRoundTrip) {
    Pings pings;
    EXPECT_FALSE(pings.offset(seconds(10)));
    ASSERT_TRUE(pings.due(seconds(10)));
    pings.hear(pongTo(seconds(10), seconds(70) + milliseconds(4)), seconds(10) + milliseconds(8));
    EXPECT_EQ(pings.offset(seconds(10) + milliseconds(8)), net::Duration{seconds(60)});
}

// Four pings of which three are answered, after 2, 2 and 8 ms.
TEST(Pings, reportRoundTripsJitterAndWhatWasNotAnswered) {
    Pings pings;
    net::Moment now = seconds(1);
    for (const int answer : {2, 2, 8, 0}) {
        const auto ping = pings.due(now);
        ASSERT_TRUE(ping);
        const net::Moment sent{ping->ping().sent_ns()};
        if (answer > 0) pings.hear(pongTo(sent, sent), sent + milliseconds(answer));
        now += milliseconds(50);
    }
    v1::NodeReport report;
    pings.report(report, seconds(3));
    EXPECT_FLOAT_EQ(report.round_trip_median_ms(), 2);
    EXPECT_FLOAT_EQ(report.jitter_ms(), 3);
    EXPECT_FLOAT_EQ(report.unanswered_percent(), 25);
}

TEST(Pings, aPingIsUnansweredOnlyAfterASecond) {
    Pings pings;
    ASSERT_TRUE(pings.due(seconds(1)));
    v1::NodeReport report;
    pings.report(report, seconds(1) + milliseconds(900));
    EXPECT_FLOAT_EQ(report.unanswered_percent(), 0);
}

}  // namespace
}  // namespace aquarama::session
