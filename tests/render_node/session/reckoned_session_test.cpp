// SPDX-License-Identifier: Apache-2.0
// A session whose master falls silent: the node makes the frames, and is led again.
#include <chrono>
#include <future>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render_node/session/dead_reckoning.h"
#include "render_node/session/session.h"
#include "tests/render_node/session/scripted_master.h"
#include "tests/support/state_packet.h"

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A master that falls silent before a node that shows its fish.
class ReckoningTest : public SessionTest {
  protected:
    // A member that has shown frames 3 and 4 of the master.
    ReckoningTest() {
        becomeMember(wire::Pace::Live, {3});
        for (const std::uint64_t frame : {3U, 4U}) {
            master_.show(frame);
            EXPECT_EQ(nextFrame(), frame);
            auto release = readying(frame);
            EXPECT_TRUE(master_.hear(v1::Envelope::kReady));
            master_.say(test::present(frame, 0));
            EXPECT_EQ(release.get(), Release::Present);
        }
    }
    // Another run of the master welcomes it.
    v1::Welcome welcomeAs(std::uint64_t run, std::uint32_t look, std::uint32_t seed = 77) {
        master_.run = run;
        EXPECT_TRUE(master_.hear(v1::Envelope::kHello));
        v1::Welcome welcome = deskWelcome();
        welcome.mutable_look()->set_number(look);
        welcome.mutable_look()->set_seed(seed);
        master_.say(test::welcome(welcome));
        return welcome;
    }
    // Shows what comes next; its number.
    std::uint64_t shown() {
        const auto state = session_->nextFrame();
        if (!state) return 0;
        EXPECT_EQ(session_->readyThenWait(state->frame), Release::Present);
        return state->frame.value;
    }
    // As the render thread does, until a frame of the master comes; empty: interrupted, or none
    // came in 20 s.
    std::future<std::optional<std::uint64_t>> showingUntilLed() {
        return std::async(std::launch::async, [this]() -> std::optional<std::uint64_t> {
            const net::Moment end = net::monotonicNow() + seconds(20);
            while (const auto state = session_->nextFrame()) {
                if (net::monotonicNow() > end) break;
                if (!session_->isReckoned()) return state->frame.value;
                if (session_->readyThenWait(state->frame) != Release::Present) break;
            }
            return std::nullopt;
        });
    }
};

TEST_F(ReckoningTest, makesItsOwnFramesWhileTheMasterIsSilent) {
    std::uint64_t last = 4;
    for (int frame = 0; frame < 200; ++frame) {  // beyond the silence after which it joins again
        const std::uint64_t next = shown();
        EXPECT_TRUE(session_->isReckoned());
        ASSERT_GT(next, last);
        EXPECT_GE(next, 4U + DeadReckoning::kSilent + 1);
        last = next;
    }
}

TEST_F(ReckoningTest, takesUpTheFramesOfTheSameRun) {
    master_.show(5);
    EXPECT_EQ(nextFrame(), 5U);
    EXPECT_EQ(readying(5).get(), Release::Skip) << "the master does not release it";
    for (int frame = 0; frame < 5; ++frame) shown();
    auto led = showingUntilLed();
    master_.show(6);
    EXPECT_EQ(led.get(), 6U);
    EXPECT_FALSE(session_->renumbered());
    auto release = readying(6);
    std::optional<v1::Envelope> ready;
    do {
        ready = master_.hear(v1::Envelope::kReady);  // of frame 5 again and again, before
        ASSERT_TRUE(ready);
    } while (ready->ready().frame() == 5);
    EXPECT_EQ(ready->ready().frame(), 6U);
    EXPECT_FALSE(ready->ready().has_released_frame()) << "the master does not know that frame";
    master_.say(test::present(6, 0));
    EXPECT_EQ(release.get(), Release::Present);
}

TEST_F(ReckoningTest, joinsAnotherRunOfTheSameShowBesideItsFrames) {
    auto led = showingUntilLed();
    welcomeAs(kRun + 7, 2);
    master_.letIn({1});
    EXPECT_EQ(led.wait_for(milliseconds(200)), std::future_status::timeout);
    master_.show(0, {}, 2);  // before the node was a member
    master_.show(1, {}, 2);
    EXPECT_EQ(led.get(), 1U);
    EXPECT_EQ(session_->renumbered(), 2U);
}

TEST_F(ReckoningTest, goesOnWhereTheNextMasterDiesBeforeItLeads) {
    auto led = showingUntilLed();
    welcomeAs(kRun + 7, 2);
    master_.letIn({1});
    welcomeAs(kRun + 9, 3);
    master_.letIn({5});
    master_.show(5, {}, 3);
    EXPECT_EQ(led.get(), 5U);
    EXPECT_EQ(session_->renumbered(), 3U);
}

TEST_F(ReckoningTest, isToldWhyAnotherMasterRefusesIt) {
    auto led = showingUntilLed();
    master_.run = kRun + 7;
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::refusal("another protocol"));
    EXPECT_FALSE(led.get());
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::refusal("another protocol"));
    EXPECT_THAT(errorOf(std::move(join)), testing::HasSubstr("another protocol"));
}

TEST_F(ReckoningTest, goesOnAtOnceWhereTheMasterHandsOver) {
    v1::Envelope message = test::dismissed("the master changes");
    message.mutable_dismissed()->set_hands_over(true);
    master_.say(message);
    EXPECT_LT(shown(), 4U + DeadReckoning::kSilent + 1);
    EXPECT_TRUE(session_->isReckoned());
    EXPECT_TRUE(master_.hear(v1::Envelope::kHello)) << "it joins whoever is the master now";
}

TEST_F(ReckoningTest, joinsAnewWhereSomethingElseIsShown) {
    auto led = showingUntilLed();
    const v1::Welcome other = welcomeAs(kRun + 7, 1, 99);
    EXPECT_FALSE(led.get());
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::welcome(other));
    EXPECT_EQ(join.get()->seed, 99U);
}

}  // namespace
}  // namespace aquarama::session
