// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/frame_reports.h"

#include <chrono>

#include <gtest/gtest.h>

namespace aquarama::session {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr net::Moment kNow{seconds(100)};

FinishedFrame finished(std::uint64_t frame, net::Duration took = milliseconds(3)) {
    return {.frame = {frame}, .released = {}, .blanks = {}, .took = took};
}

// The master's clock is a minute ahead.
Pings aMinuteAhead() {
    Pings pings;
    EXPECT_TRUE(pings.due(kNow));
    v1::Pong pong;
    pong.set_sent_ns(kNow.time_since_epoch().count());
    pong.set_master_ns((kNow + seconds(60)).time_since_epoch().count());
    pings.hear(pong, kNow);
    return pings;
}

TEST(FrameReports, readyIsSaidAtOnceAndAgainUntilTheFrameIsReleased) {
    FrameReports reports;
    EXPECT_FALSE(reports.due({}, kNow, 0));
    reports.finish(finished(7, microseconds(1500)));
    const auto ready = reports.due({}, kNow, 0);
    ASSERT_TRUE(ready);
    EXPECT_EQ(ready->ready().frame(), 7U);
    EXPECT_EQ(ready->ready().picture_us(), 1500U);
    EXPECT_FALSE(reports.due({}, kNow + milliseconds(50), 0));
    EXPECT_TRUE(reports.due({}, kNow + milliseconds(110), 0));
    reports.release({6});
    EXPECT_TRUE(reports.due({}, kNow + seconds(3), 0));
    reports.release({7});
    EXPECT_FALSE(reports.due({}, kNow + seconds(6), 0));
    EXPECT_EQ(reports.lastFinished(), Frame{7});
}

TEST(FrameReports, eachFinishedFrameIsReadyAtOnce) {
    FrameReports reports;
    for (const std::uint64_t frame : {1U, 2U}) {
        reports.finish(finished(frame));
        const auto ready = reports.due({}, kNow, 0);
        ASSERT_TRUE(ready);
        EXPECT_EQ(ready->ready().frame(), frame);
    }
}

TEST(FrameReports, momentsAreOfTheMastersClock) {
    FrameReports reports;
    FinishedFrame frame = finished(8);
    frame.released = ReleaseReport{{7}, kNow - milliseconds(9)};
    frame.blanks = net::Blanks{kNow - milliseconds(2), milliseconds(16)};
    reports.finish(frame);
    const v1::Ready ready = reports.due(aMinuteAhead(), kNow, 0).value().ready();
    EXPECT_EQ(ready.released_frame(), 7U);
    EXPECT_EQ(net::Moment{net::Duration{ready.released_ns()}},
              kNow + seconds(60) - milliseconds(9));
    EXPECT_EQ(net::Moment{net::Duration{ready.blank_ns()}}, kNow + seconds(60) - milliseconds(2));
    EXPECT_EQ(ready.blank_period_ns(), 16'000'000U);
}

}  // namespace
}  // namespace aquarama::session
