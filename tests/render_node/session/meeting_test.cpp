// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/meeting.h"

#include <gtest/gtest.h>

namespace aquarama::session {
namespace {

ArrivedState stateOf(std::uint64_t frame) {
    wire::StateFrame state;
    state.frame = {frame};
    return {state, net::Instant{static_cast<std::int64_t>(frame)}};
}

std::uint64_t taken(Meeting& meeting) {
    return meeting.takeState().value().state.frame.value;
}

TEST(Meeting, lockstepGivesEveryFrameInOrderHoweverTheyArrive) {
    Meeting meeting;
    for (const std::uint64_t frame : {6, 4, 5, 4, 3, 7}) meeting.put(stateOf(frame));
    meeting.start(wire::Pace::Lockstep, {4});
    for (const std::uint64_t frame : {4, 5, 6, 7}) EXPECT_EQ(taken(meeting), frame);
    meeting.put(stateOf(5));  // sent again for somebody else
    meeting.put(stateOf(8));
    EXPECT_EQ(taken(meeting), 8U);
}

TEST(Meeting, liveGivesTheNewest) {
    Meeting meeting;
    meeting.start(wire::Pace::Live, {0});
    for (const std::uint64_t frame : {0, 1, 2}) meeting.put(stateOf(frame));
    EXPECT_EQ(taken(meeting), 2U);
    meeting.put(stateOf(1));
    meeting.put(stateOf(3));
    EXPECT_EQ(taken(meeting), 3U);
}

TEST(Meeting, keepsOnlyTheLastFewStates) {
    Meeting meeting;
    for (std::uint64_t frame = 0; frame < 1000; ++frame) meeting.put(stateOf(frame));
    meeting.start(wire::Pace::Lockstep, {992});
    EXPECT_EQ(taken(meeting), 992U);
}

TEST(Meeting, theNewestReleaseCounts) {
    Meeting meeting;
    meeting.release({{5}, net::Instant{50}});
    meeting.release({{4}, net::Instant{40}});
    EXPECT_EQ(meeting.awaitRelease({3})->frame, Frame{5});
    EXPECT_EQ(meeting.awaitRelease({5})->at, net::Instant{50});
}

TEST(Meeting, aReleaseThatHasComeIsGivenBeforeTheEnd) {
    Meeting meeting;
    meeting.release({{5}, net::Instant{50}});
    meeting.interrupt(Release::Quit);
    EXPECT_TRUE(meeting.awaitRelease({5}));
    EXPECT_FALSE(meeting.awaitRelease({6}));
    EXPECT_FALSE(meeting.takeState());
}

TEST(Meeting, aNewJoinForgetsTheOldShowButNotItsEnd) {
    Meeting meeting;
    meeting.start(wire::Pace::Live, {0});
    meeting.put(stateOf(500));
    meeting.release({{500}, {}});
    meeting.interrupt(Release::Rejoin);
    EXPECT_FALSE(meeting.takeState());
    meeting.expectJoin();
    meeting.start(wire::Pace::Live, {0});
    meeting.put(stateOf(2));
    EXPECT_EQ(taken(meeting), 2U);
    meeting.interrupt(Release::Quit);
    meeting.interrupt(Release::Rejoin);
    meeting.expectJoin();
    EXPECT_TRUE(std::holds_alternative<Ended>(meeting.awaitJoin()));
    EXPECT_EQ(meeting.interruption(), Release::Quit);
}

}  // namespace
}  // namespace aquarama::session
