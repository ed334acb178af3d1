// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/presentation.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/master/conductor/parts.h"
#include "tests/support/messages.h"
#include "tests/support/stage.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A world that is as far as a test lets it be.
class Source final : public FrameSource {
  public:
    std::optional<Snapshot> takeTick() override {
        if (ticks == 0) return std::nullopt;
        --ticks;
        Snapshot snapshot = world_.snapshot();
        world_.advance();
        return snapshot;
    }
    const v1::Show& showOf(Frame /*frame*/, net::Moment /*now*/) override { return show_; }
    void onReleased(Frame frame) override { released.push_back(frame.value); }

    int ticks = 1000;
    std::vector<std::uint64_t> released;

  private:
    test::CountingWorld world_;
    v1::Show show_;
};

// Frames of a desk by a clock that the test moves. Nobody takes part yet.
class DeskFrames : public testing::Test {
  protected:
    void begin(bool lockstep, std::optional<std::uint64_t> frames = {}) {
        presentation.emplace(PresentationLimits{.barrier = {.lockstep = lockstep,
                                                            .deadline = milliseconds(16),
                                                            .membership = seconds(5),
                                                            .patience = seconds(60)},
                                                .refresh = milliseconds(16),
                                                .frames = frames,
                                                .traceDirectory = {}},
                             parts.roster,
                             parts.sender,
                             channels,
                             gauges,
                             report,
                             source,
                             now);
    }
    void admit(const std::string& name) {
        parts.join(name);
        presentation->barrier().heard(parts.roster.named(name).value(), now);
        presentation->admit(parts.roster.named(name).value(), now);
    }
    void ready(const std::string& name, std::uint64_t frame) {
        presentation->ready(parts.roster.named(name).value(), test::ready(frame).ready(), now);
    }
    std::ptrdiff_t states() const { return channels.count(v1::Envelope::kState); }
    std::ptrdiff_t presents(const std::string& name) {
        return parts.count(name, v1::Envelope::kPresent);
    }

    test::Parts parts;
    test::PublishedStates channels;
    ShowReport report;
    Gauges gauges{parts.roster, 0};
    Source source;
    std::optional<Presentation> presentation;
    net::Moment now = test::kStart;
};

TEST_F(DeskFrames, inLockstepTheFirstStateWaitsForEveryNode) {
    begin(true);
    admit("left");
    admit("middle");
    presentation->turn(now);
    EXPECT_EQ(states(), 0);
    admit("right");
    presentation->turn(now);
    EXPECT_EQ(states(), 1);
}

TEST_F(DeskFrames, aFrameIsReleasedToAllWhenAllAreReadyAndTheLastEndsTheShow) {
    begin(true, 2);
    for (const char* name : {"left", "middle", "right"}) admit(name);
    presentation->turn(now);
    ready("left", 0);
    ready("middle", 0);
    presentation->turn(now);
    EXPECT_EQ(presents("left"), 0);
    ready("right", 0);
    presentation->turn(now);
    for (const char* name : {"left", "middle", "right"}) EXPECT_EQ(presents(name), 1) << name;
    EXPECT_FALSE(presentation->isOver());
    for (const char* name : {"left", "middle", "right"}) ready(name, 1);
    presentation->turn(now);
    EXPECT_EQ(source.released, (std::vector<std::uint64_t>{0, 1}));
    EXPECT_TRUE(presentation->isOver());
    EXPECT_EQ(report.frames, 2U);
    EXPECT_EQ(report.tick, Tick{1});
    EXPECT_EQ(report.worldHash, test::CountingWorld::hashAt({1}));
    EXPECT_EQ(states(), 2) << "none is published that is never shown";
}

TEST_F(DeskFrames, aShowOfNoFramesIsOverAtOnce) {
    begin(true, 0);
    EXPECT_TRUE(presentation->isOver());
}

TEST_F(DeskFrames, aNodeThatMissedTheReleaseHearsItAgain) {
    begin(true);
    for (const char* name : {"left", "middle", "right"}) admit(name);
    presentation->turn(now);
    for (const char* name : {"left", "middle", "right"}) ready(name, 0);
    presentation->turn(now);
    ready("middle", 0);
    EXPECT_EQ(presents("middle"), 2);
    EXPECT_EQ(presents("left"), 1);
}

TEST_F(DeskFrames, aSilentNodeEndsAShowInLockstep) {
    begin(true);
    for (const char* name : {"left", "middle", "right"}) admit(name);
    presentation->turn(now);
    for (const std::size_t node : {0, 2}) presentation->barrier().heard(node, now + seconds(50));
    presentation->turn(now + seconds(61));
    EXPECT_THAT(presentation->failure(),
                testing::HasSubstr("node \"middle\" has been silent for 60 s"));
    EXPECT_TRUE(presentation->isOver());
}

TEST_F(DeskFrames, liveASilentNodeIsDismissedAndTheOthersGoOn) {
    begin(false);
    admit("left");
    admit("right");
    presentation->barrier().heard(2, now + seconds(4));
    presentation->turn(now + seconds(6));
    EXPECT_EQ(parts.count("left", v1::Envelope::kDismissed), 1);
    EXPECT_TRUE(parts.seat("left").peer.empty());
    EXPECT_EQ(parts.seat("left").dropped, 1U);
    EXPECT_EQ(parts.count("right", v1::Envelope::kDismissed), 0);
    EXPECT_EQ(states(), 1);
    EXPECT_TRUE(presentation->failure().empty());
}

TEST_F(DeskFrames, liveAFrameIsReleasedWithoutTheOneThatMissesTheDeadline) {
    begin(false);
    admit("left");
    admit("right");
    presentation->turn(now);
    ready("left", 0);
    presentation->turn(now += milliseconds(15));
    EXPECT_EQ(presents("left"), 0);
    presentation->turn(now += milliseconds(2));
    EXPECT_EQ(presents("left"), 1);
    EXPECT_EQ(presents("right"), 1) << "it may still show it";
    EXPECT_FALSE(presentation->barrier().isWaitedFor(2));
}

// It may be lost on its way; a node that is only slow must not get a flood of them.
TEST_F(DeskFrames, aStateThatNobodyAnswersIsPublishedAgainLessAndLessOften) {
    begin(false);
    admit("left");
    presentation->turn(now);
    ASSERT_EQ(states(), 1);
    std::vector<int> again;
    for (int ms = 17; ms < 250; ++ms) {
        const std::ptrdiff_t before = states();
        presentation->turn(now + milliseconds(ms));
        if (states() > before) again.push_back(ms);
    }
    EXPECT_EQ(again, (std::vector<int>{17, 17 + 33, 17 + 33 + 65, 17 + 33 + 65 + 129}));
}

TEST_F(DeskFrames, nothingIsPublishedBeforeTheWorldHasATick) {
    begin(false);
    source.ticks = 0;
    admit("left");
    presentation->turn(now);
    EXPECT_EQ(states(), 0);
    source.ticks = 1;
    presentation->turn(now);
    EXPECT_EQ(states(), 1);
}

TEST_F(DeskFrames, aBeaconIsPublishedWhileThereAreNoFrames) {
    begin(false);
    for (int ms = 0; ms < 200; ++ms) presentation->turn(now + milliseconds(ms));
    EXPECT_EQ(channels.count(v1::Envelope::kBeacon), 4) << "every 51 ms";
    EXPECT_EQ(states(), 0);
}

}  // namespace
}  // namespace aquarama::conductor
