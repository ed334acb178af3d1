// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/mailbox.h"

#include <chrono>
#include <future>
#include <thread>

#include <gtest/gtest.h>

namespace aquarama::session {
namespace {

ArrivedState stateOf(std::uint64_t frame) {
    wire::StateFrame state;
    state.frame = {frame};
    return {state, net::Moment{std::chrono::seconds(frame)}};
}

std::uint64_t taken(Mailbox& mailbox) {
    return mailbox.takeState().value().state.frame.value;
}

TEST(Mailbox, lockstepGivesEveryFrameInOrderHoweverTheyArrive) {
    Mailbox mailbox;
    for (const std::uint64_t frame : {6U, 4U, 5U, 4U, 3U, 7U}) mailbox.put(stateOf(frame));
    mailbox.start(wire::Pace::Lockstep, {4});
    for (const std::uint64_t frame : {4U, 5U, 6U, 7U}) EXPECT_EQ(taken(mailbox), frame);
    mailbox.put(stateOf(5));  // sent again for somebody else
    mailbox.put(stateOf(8));
    EXPECT_EQ(taken(mailbox), 8U);
}

TEST(Mailbox, liveGivesTheNewest) {
    Mailbox mailbox;
    mailbox.start(wire::Pace::Live, {0});
    for (const std::uint64_t frame : {0U, 1U, 2U}) mailbox.put(stateOf(frame));
    EXPECT_EQ(taken(mailbox), 2U);
    mailbox.put(stateOf(1));
    mailbox.put(stateOf(3));
    EXPECT_EQ(taken(mailbox), 3U);
}

// The render thread already waits when it comes, and has shown frame 9 of the run before.
TEST(Mailbox, theFirstFrameOfAnotherMasterMayComeBeforeItsStart) {
    Mailbox mailbox;
    mailbox.start(wire::Pace::Live, {9});
    mailbox.put(stateOf(9));
    EXPECT_EQ(taken(mailbox), 9U);
    mailbox.interrupt(Release::Rejoin);
    mailbox.expectJoin();
    auto waiting = std::async(std::launch::async, [&] { return mailbox.takeState(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    mailbox.put(stateOf(0));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    mailbox.start(wire::Pace::Live, {0});
    const auto came = waiting.wait_for(std::chrono::seconds(5));
    mailbox.interrupt(Release::Quit);
    EXPECT_EQ(came, std::future_status::ready);
    EXPECT_TRUE(waiting.get());
}

TEST(Mailbox, keepsOnlyTheLastFewStates) {
    Mailbox mailbox;
    for (std::uint64_t frame = 0; frame < 1000; ++frame) mailbox.put(stateOf(frame));
    mailbox.start(wire::Pace::Lockstep, {992});
    EXPECT_EQ(taken(mailbox), 992U);
}

TEST(Mailbox, theNewestReleaseCounts) {
    Mailbox mailbox;
    mailbox.release({{5}, net::Moment{std::chrono::seconds(50)}});
    mailbox.release({{4}, net::Moment{std::chrono::seconds(40)}});
    EXPECT_EQ(mailbox.awaitRelease({3})->frame, Frame{5});
    EXPECT_EQ(mailbox.awaitRelease({5})->at, net::Moment{std::chrono::seconds(50)});
}

TEST(Mailbox, aReleaseThatHasComeIsGivenBeforeTheEnd) {
    Mailbox mailbox;
    mailbox.release({{5}, net::Moment{std::chrono::seconds(50)}});
    mailbox.interrupt(Release::Quit);
    EXPECT_TRUE(mailbox.awaitRelease({5}));
    EXPECT_FALSE(mailbox.awaitRelease({6}));
    EXPECT_FALSE(mailbox.takeState());
}

TEST(Mailbox, aNewJoinForgetsTheOldShowButNotItsEnd) {
    Mailbox mailbox;
    mailbox.start(wire::Pace::Live, {0});
    mailbox.put(stateOf(500));
    mailbox.release({{500}, {}});
    mailbox.interrupt(Release::Rejoin);
    EXPECT_FALSE(mailbox.takeState());
    mailbox.expectJoin();
    mailbox.start(wire::Pace::Live, {0});
    mailbox.put(stateOf(2));
    EXPECT_EQ(taken(mailbox), 2U);
    mailbox.interrupt(Release::Quit);
    mailbox.interrupt(Release::Rejoin);
    mailbox.expectJoin();
    EXPECT_TRUE(std::holds_alternative<Ended>(mailbox.awaitJoin()));
    EXPECT_EQ(mailbox.interruption(), Release::Quit);
}

}  // namespace
}  // namespace aquarama::session
