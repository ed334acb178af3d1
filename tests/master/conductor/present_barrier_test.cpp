// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/present_barrier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace aquarama::conductor {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Verdict = PresentBarrier::Verdict;

constexpr std::size_t kLeft = 0, kMiddle = 1, kRight = 2;

// Three nodes, a deadline of 16 ms, membership for 250 ms of silence, patience of 60 s.
BarrierLimits limits(bool lockstep) {
    return {lockstep, milliseconds(16), milliseconds(250), std::chrono::seconds(60)};
}

PresentBarrier drawing(Frame frame, bool lockstep) {
    PresentBarrier barrier(3, limits(lockstep), {});
    for (const std::size_t node : {kLeft, kMiddle, kRight}) barrier.join(node, frame);
    barrier.begin(frame);
    return barrier;
}

net::Moment at(int ms) {
    return net::Moment{milliseconds(ms)};
}

TEST(PresentBarrier, presentsOnlyWhenTheLastIsReady) {
    for (const bool lockstep : {false, true}) {
        PresentBarrier barrier = drawing({4}, lockstep);
        EXPECT_EQ(barrier.decide(at(1)).verdict, Verdict::Wait);
        barrier.ready(kRight, {4}, at(2));
        barrier.ready(kLeft, {4}, at(3));
        EXPECT_EQ(barrier.decide(at(3)).verdict, Verdict::Wait);
        barrier.ready(kMiddle, {4}, at(4));
        EXPECT_EQ(barrier.decide(at(4)).verdict, Verdict::Present);
    }
}

TEST(PresentBarrier, aFrameThatIsBegunForgetsWhoWasReadyForTheLast) {
    PresentBarrier barrier = drawing({4}, false);
    for (const std::size_t node : {kLeft, kMiddle, kRight}) barrier.ready(node, {4}, at(1));
    barrier.begin({5});
    EXPECT_FALSE(barrier.anyReady());
    EXPECT_EQ(barrier.decide(at(2)).verdict, Verdict::Wait);
}

TEST(PresentBarrier, theDeadlineCountsFromTheFirstThatIsReady) {
    PresentBarrier barrier = drawing({0}, false);
    // However slow the wall: there is nothing to present before somebody is ready.
    const auto waiting = barrier.decide(at(5000));
    EXPECT_EQ(waiting.verdict, Verdict::Wait);
    EXPECT_FALSE(waiting.until);
    barrier.ready(kLeft, {0}, at(5000));
    const auto decision = barrier.decide(at(5001));
    EXPECT_EQ(decision.verdict, Verdict::Wait);
    EXPECT_EQ(decision.until, at(5016));
    EXPECT_EQ(barrier.decide(at(5016)).verdict, Verdict::Present);
}

TEST(PresentBarrier, whoMissesTheDeadlineIsNotWaitedForAgain) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(0));
    barrier.ready(kMiddle, {0}, at(1));
    ASSERT_EQ(barrier.decide(at(16)).verdict, Verdict::Present);
    EXPECT_FALSE(barrier.isWaitedFor(kRight));
    EXPECT_TRUE(barrier.isMember(kRight));
    EXPECT_EQ(barrier.timesLate(kRight), 1U);
    barrier.begin({1});
    barrier.ready(kLeft, {1}, at(20));
    barrier.ready(kMiddle, {1}, at(20));
    EXPECT_EQ(barrier.decide(at(20)).verdict, Verdict::Present);
    EXPECT_EQ(barrier.timesLate(kRight), 1U);
}

TEST(PresentBarrier, aLateNodeComesBackWhenItIsReadyForTheFrameThatIsDrawn) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(0));
    ASSERT_EQ(barrier.decide(at(16)).verdict, Verdict::Present);
    barrier.begin({7});
    barrier.ready(kRight, {7}, at(30));
    EXPECT_TRUE(barrier.isWaitedFor(kRight));
    EXPECT_EQ(barrier.decide(at(31)).verdict, Verdict::Wait);  // for the left one
}

TEST(PresentBarrier, aNodeOnlyJustTooLateIsWaitedForInTheNextFrame) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(0));
    ASSERT_EQ(barrier.decide(at(16)).verdict, Verdict::Present);
    barrier.begin({1});
    barrier.ready(kRight, {0}, at(18));
    EXPECT_TRUE(barrier.isWaitedFor(kRight));
    EXPECT_FALSE(barrier.anyReady());  // its picture was the last frame's
    EXPECT_FALSE(barrier.isWaitedFor(kMiddle));
}

// The state of the next frame is published while this one is drawn: a late node may take it at
// once.
TEST(PresentBarrier, aLateNodeThatIsAheadIsWaitedForFromItsFrameOn) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(0));
    barrier.ready(kMiddle, {0}, at(0));
    ASSERT_EQ(barrier.decide(at(16)).verdict, Verdict::Present);
    barrier.begin({1});
    barrier.ready(kRight, {2}, at(30));
    EXPECT_FALSE(barrier.isWaitedFor(kRight));  // it does not draw frame 1
    EXPECT_FALSE(barrier.anyReady());
    barrier.ready(kLeft, {1}, at(40));
    EXPECT_EQ(barrier.decide(at(40)).verdict, Verdict::Wait);
    barrier.ready(kMiddle, {1}, at(41));
    ASSERT_EQ(barrier.decide(at(41)).verdict, Verdict::Present);
    barrier.begin({2});
    EXPECT_TRUE(barrier.isWaitedFor(kRight));
    // The others take frame 2 first: no later state is to be published before one of them is ready.
    EXPECT_FALSE(barrier.anyReady());
    EXPECT_EQ(barrier.decide(at(50)).until, at(300));  // a membership's time
    barrier.ready(kLeft, {2}, at(60));
    EXPECT_TRUE(barrier.anyReady());
    EXPECT_EQ(barrier.decide(at(60)).until, at(76));
    barrier.ready(kMiddle, {2}, at(61));
    EXPECT_EQ(barrier.decide(at(61)).verdict, Verdict::Present);
    EXPECT_EQ(barrier.timesLate(kRight), 1U);
}

TEST(PresentBarrier, aNodeSeveralFramesBehindStaysOut) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(0));
    ASSERT_EQ(barrier.decide(at(16)).verdict, Verdict::Present);
    barrier.begin({1});
    barrier.ready(kLeft, {1}, at(20));
    barrier.begin({2});
    barrier.ready(kRight, {0}, at(40));
    EXPECT_FALSE(barrier.isWaitedFor(kRight));
}

// Three nodes that need 100 ms a frame, and start 40 ms apart: more than a deadline.
TEST(PresentBarrier, aSlowSoftwareWallFallsIntoStep) {
    PresentBarrier barrier = drawing({0}, false);
    std::vector<int> doneAt = {100, 120, 140};
    std::vector<std::uint64_t> draws = {0, 0, 0};
    std::uint64_t frame = 0;
    for (int now = 0; now < 3000; ++now) {
        for (std::size_t node = 0; node < 3; ++node) {
            barrier.heard(node, at(now));
            if (now == doneAt[node]) barrier.ready(node, {draws[node]}, at(now));
            // Too late for its own frame: it takes the one that is drawn now.
            if (now >= doneAt[node] && draws[node] < frame) {
                draws[node] = frame;
                doneAt[node] = now + 100;
            }
        }
        if (barrier.decide(at(now)).verdict == Verdict::Present) barrier.begin({++frame});
    }
    EXPECT_EQ(doneAt[0], doneAt[1]);
    EXPECT_EQ(doneAt[1], doneAt[2]);
    EXPECT_GE(frame, 25U);
}

// A node takes the newest state, draws it for 4 to 8 ms, waits until that frame or a later one is
// released, and shows it then.
struct SimulatedNode {
    std::uint64_t draws = 0;
    int doneAt = 0;
    bool waits = false;
    std::vector<std::uint64_t> shown;
};

// One of three nodes is held up for 30 to 230 ms: afterwards all show the same frames, each of
// them, in whatever moment of a frame it came back.
TEST(PresentBarrier, aNodeThatWasHeldUpShowsAllFramesWithTheOthersAgain) {
    constexpr int kLead = 2;  // from the word to the release
    for (unsigned seed = 1; seed <= 200; ++seed) {
        std::mt19937 random(seed);
        PresentBarrier barrier = drawing({0}, false);
        std::array<SimulatedNode, 3> nodes{};
        int heldUpFor = 30 + static_cast<int>(random() % 200);
        std::uint64_t frame = 0, published = 0;
        int releasedAt = 0;
        for (int now = 1; now < 1500; ++now) {
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                SimulatedNode& node = nodes[i];
                barrier.heard(i, at(now));
                if (now >= 300 && i == kRight && !node.waits)
                    node.doneAt += std::exchange(heldUpFor, 0);
                if (!node.waits && now >= node.doneAt) {
                    barrier.ready(i, {node.draws}, at(now));
                    node.waits = true;
                }
                if (!node.waits || node.draws >= frame || now < releasedAt) continue;
                if (node.draws + 1 == frame) node.shown.push_back(node.draws);
                if (node.draws == published) continue;
                node.draws = published;
                node.doneAt = now + 4 + static_cast<int>(random() % 5);
                node.waits = false;
            }
            const auto verdict = barrier.decide(at(now)).verdict;
            if (barrier.anyReady()) published = frame + 1;
            if (verdict != Verdict::Present) continue;
            published = std::max(published, ++frame);
            releasedAt = now + kLead;
            barrier.begin({frame});
        }
        for (SimulatedNode& node : nodes)
            std::erase_if(node.shown, [&](std::uint64_t f) { return f + 40 < frame; });
        EXPECT_GE(nodes[kLeft].shown.size(), 38U) << "seed " << seed;
        EXPECT_EQ(nodes[kMiddle].shown, nodes[kLeft].shown) << "seed " << seed;
        EXPECT_EQ(nodes[kRight].shown, nodes[kLeft].shown) << "seed " << seed;
    }
}

TEST(PresentBarrier, aNodeThatIsMerelySlowStaysAMemberWhileItsNetThreadSpeaks) {
    PresentBarrier barrier = drawing({0}, false);
    for (int now = 0; now < 10000; now += 50) {
        for (const std::size_t node : {kLeft, kMiddle, kRight}) barrier.heard(node, at(now));
        EXPECT_TRUE(barrier.expelSilent(at(now)).empty());
    }
}

TEST(PresentBarrier, aSilentNodeIsNoMemberAfterItsTime) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.heard(kLeft, at(200));
    barrier.heard(kMiddle, at(200));
    EXPECT_TRUE(barrier.expelSilent(at(250)).empty());
    EXPECT_EQ(barrier.expelSilent(at(251)), std::vector<std::size_t>{kRight});
    EXPECT_FALSE(barrier.isMember(kRight));
    EXPECT_TRUE(barrier.expelSilent(at(252)).empty());
    barrier.ready(kRight, {0}, at(253));  // what was still on its way does not count
    EXPECT_FALSE(barrier.anyReady());
}

TEST(PresentBarrier, theWallGoesOnWhenTheNodeItWaitsForDies) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.heard(kLeft, at(200));
    barrier.heard(kMiddle, at(200));
    barrier.ready(kLeft, {0}, at(244));
    barrier.ready(kMiddle, {0}, at(245));
    EXPECT_EQ(barrier.decide(at(246)).verdict, Verdict::Wait);
    EXPECT_EQ(barrier.expelSilent(at(251)).size(), 1U);
    EXPECT_EQ(barrier.decide(at(251)).verdict, Verdict::Present);
}

TEST(PresentBarrier, nothingIsPresentedWhenTheOnlyReadyNodeDied) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(1));
    barrier.leave(kLeft);
    EXPECT_EQ(barrier.decide(at(100)).verdict, Verdict::Wait);
    EXPECT_TRUE(barrier.isWaitedFor(kMiddle));
}

TEST(PresentBarrier, aNewcomerIsWaitedForFromTheFirstFrameThatItSees) {
    PresentBarrier barrier(3, limits(false), at(0));
    barrier.join(kLeft, {0});
    barrier.begin({0});
    EXPECT_FALSE(barrier.nextAwaited());
    barrier.join(kRight, {2});
    EXPECT_FALSE(barrier.isWaitedFor(kRight));
    EXPECT_EQ(barrier.nextAwaited(), Frame{2});
    barrier.begin({1});
    EXPECT_FALSE(barrier.isWaitedFor(kRight));
    barrier.begin({2});
    EXPECT_TRUE(barrier.isWaitedFor(kRight));
    EXPECT_FALSE(barrier.nextAwaited());
}

TEST(PresentBarrier, aNodeThatIsAheadDoesNotWaitForOnesThatHang) {
    PresentBarrier barrier = drawing({0}, false);
    barrier.ready(kLeft, {0}, at(0));
    ASSERT_EQ(barrier.decide(at(16)).verdict, Verdict::Present);
    barrier.begin({1});
    barrier.ready(kMiddle, {2}, at(20));
    barrier.ready(kLeft, {1}, at(20));
    ASSERT_EQ(barrier.decide(at(36)).verdict, Verdict::Present);
    barrier.begin({2});
    EXPECT_EQ(barrier.decide(at(40)).verdict, Verdict::Wait);
    EXPECT_EQ(barrier.decide(at(289)).verdict, Verdict::Wait);
    EXPECT_EQ(barrier.decide(at(290)).verdict, Verdict::Present);
    EXPECT_FALSE(barrier.isWaitedFor(kLeft));
}

// Nobody draws frame 0 any more: frame 1, for which a node is ready, comes next.
TEST(PresentBarrier, aNodeThatIsAheadAloneIsNotLeftWaiting) {
    PresentBarrier barrier(3, limits(false), at(0));
    barrier.join(kLeft, {0});
    barrier.begin({0});
    barrier.ready(kLeft, {1}, at(5));
    EXPECT_EQ(barrier.decide(at(5)).verdict, Verdict::Idle);
    ASSERT_EQ(barrier.nextAwaited(), Frame{1});
    barrier.begin({1});
    EXPECT_EQ(barrier.decide(at(6)).verdict, Verdict::Present);
}

TEST(PresentBarrier, anEmptyWallIsIdle) {
    PresentBarrier barrier(3, limits(false), at(0));
    EXPECT_EQ(barrier.decide(at(9)).verdict, Verdict::Idle);
    barrier.join(kLeft, {1});
    barrier.begin({0});
    EXPECT_EQ(barrier.decide(at(9)).verdict, Verdict::Idle);
}

TEST(PresentBarrier, lockstepWaitsForNodesThatNeverCameAndNamesTheSilentOne) {
    PresentBarrier barrier(3, limits(true), at(0));
    for (const std::size_t node : {kLeft, kRight}) barrier.join(node, {0});
    EXPECT_FALSE(barrier.allPrepared());
    barrier.begin({0});
    for (const std::size_t node : {kLeft, kRight}) barrier.heard(node, at(59000));
    for (const std::size_t node : {kLeft, kRight}) barrier.ready(node, {0}, at(59000));
    const auto waiting = barrier.decide(at(59999));
    EXPECT_EQ(waiting.verdict, Verdict::Wait);
    EXPECT_EQ(waiting.until, at(60000));
    const auto decision = barrier.decide(at(60000));
    EXPECT_EQ(decision.verdict, Verdict::Silent);
    EXPECT_EQ(decision.node, kMiddle);
}

TEST(PresentBarrier, lockstepKnowsNoDeadlineAndDropsNobody) {
    PresentBarrier barrier = drawing({0}, true);
    barrier.ready(kLeft, {0}, at(1));
    EXPECT_EQ(barrier.decide(at(30000)).verdict, Verdict::Wait);
    EXPECT_TRUE(barrier.expelSilent(at(30000)).empty());
    EXPECT_TRUE(barrier.isMember(kRight));
}

TEST(PresentBarrier, lockstepWaitsForANodeThatStartsAgain) {
    PresentBarrier barrier = drawing({3}, true);
    for (const std::size_t node : {kLeft, kMiddle, kRight}) barrier.ready(node, {3}, at(1));
    barrier.leave(kMiddle);
    EXPECT_EQ(barrier.decide(at(2)).verdict, Verdict::Wait);
    barrier.join(kMiddle, {3});
    EXPECT_EQ(barrier.decide(at(3)).verdict, Verdict::Wait);
    barrier.ready(kMiddle, {3}, at(4));
    EXPECT_EQ(barrier.decide(at(4)).verdict, Verdict::Present);
}

// Nodes of random speed that freeze, die and come back, ten seconds each: at no instant is a frame
// presented that somebody in the wait set was not ready for.
TEST(PresentBarrier, neverPresentsWhatTheWaitSetIsNotReadyFor) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        PresentBarrier barrier = drawing({0}, false);
        std::vector<std::uint64_t> readyFor(3, UINT64_MAX);
        std::uint64_t frame = 0;
        for (int now = 0; now < 10000; ++now) {
            const std::size_t node = random() % 3;
            const auto what = random() % 100;
            if (what < 60) barrier.heard(node, at(now));
            if (what < 20 && barrier.isMember(node)) {
                barrier.ready(node, {frame}, at(now));
                readyFor[node] = frame;
            }
            if (what == 99) barrier.leave(node);
            if (what == 98) barrier.join(node, {frame + 1});
            static_cast<void>(barrier.expelSilent(at(now)));
            if (barrier.decide(at(now)).verdict != Verdict::Present) continue;
            bool anyReady = false;
            for (std::size_t other = 0; other < 3; ++other) {
                if (barrier.isWaitedFor(other)) {
                    EXPECT_EQ(readyFor[other], frame) << "seed " << seed;
                }
                anyReady = anyReady || readyFor[other] == frame;
            }
            EXPECT_TRUE(anyReady) << "seed " << seed;
            barrier.begin({++frame});
        }
        EXPECT_GT(frame, 100U);
    }
}

// Displays that are not locked to each other, each with a node that swaps when it is told to, and
// shows the frame at the blank that follows.
class UnlockedDisplays {
  public:
    // Hertz of each; phases, and all that wavers, are drawn from the seed.
    UnlockedDisplays(unsigned seed, const std::vector<double>& hertz) : random_(seed) {
        for (const double rate : hertz)
            blanks_.push_back({net::Moment{uniform(milliseconds(0), milliseconds(16))},
                               net::Duration{std::llround(1e9 / rate)}});
    }

    // As they are reported: up to half a second old, and 0.1 ms beside the truth.
    std::vector<net::Blanks> reported(net::Moment now) {
        std::vector<net::Blanks> all = blanks_;
        for (net::Blanks& display : all) {
            const net::Moment moment = now - uniform(milliseconds(0), milliseconds(500));
            display.last = next(display, moment) - display.period +
                           uniform(microseconds(-100), microseconds(100));
        }
        return all;
    }
    // Shows the next frame everywhere. Swaps are up to 0.5 ms late.
    void release(net::Moment at) {
        std::vector<net::Moment> shown;
        for (const net::Blanks& display : blanks_)
            shown.push_back(next(display, at + uniform(microseconds(0), microseconds(500))));
        shownAt_.push_back(std::move(shown));
    }
    // The latest display's blank of a frame after the earliest's, the worst of all frames.
    net::Duration worstSpread() const {
        net::Duration worst{};
        for (const auto& shown : shownAt_) {
            const auto [first, last] = std::ranges::minmax(shown);
            worst = std::max(worst, last - first);
        }
        return worst;
    }
    // How often a display showed a frame not for just one of its periods.
    int irregular() const {
        int count = 0;
        for (std::size_t frame = 1; frame < shownAt_.size(); ++frame)
            for (std::size_t i = 0; i < blanks_.size(); ++i)
                if (shownAt_[frame][i] - shownAt_[frame - 1][i] != blanks_[i].period) ++count;
        return count;
    }
    net::Duration uniform(net::Duration least, net::Duration most) {
        return net::Duration{std::uniform_int_distribution(least.count(), most.count())(random_)};
    }

  private:
    static net::Moment next(const net::Blanks& display, net::Moment after) {
        return display.last +
               ((after - display.last) / display.period + 1) * display.period;  // after > last
    }

    std::mt19937_64 random_;
    std::vector<net::Blanks> blanks_;
    std::vector<std::vector<net::Moment>> shownAt_;
};

constexpr net::Duration kRefresh{16'666'667};

// A minute. All are ready 3 to 12 ms after the last release, and a release needs 2 ms.
void playMinute(UnlockedDisplays& displays, bool knowsPhases) {
    net::Moment last{std::chrono::seconds(1)};
    while (last < at(61000)) {
        const net::Moment earliest = last + displays.uniform(milliseconds(5), milliseconds(14));
        const auto phases = knowsPhases ? displays.reported(earliest) : std::vector<net::Blanks>{};
        last = releaseTime(earliest, last, kRefresh, phases);
        displays.release(last);
    }
}

// Of three phases two neighbours are a third of the circle apart or more; a gap is kept until
// another is a quarter wider.
constexpr net::Duration kSpreadOfThree = kRefresh - kRefresh * 4 / 15 + milliseconds(1);

TEST(ReleaseTime, framesNeverMixOnUnlockedDisplaysOfOneRate) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        UnlockedDisplays displays(seed, {59.94, 59.94, 59.94});
        playMinute(displays, true);
        EXPECT_LT(displays.worstSpread(), kSpreadOfThree) << "seed " << seed;
        // The gap that it begins in may be just too narrow to be kept: one change.
        EXPECT_LE(displays.irregular(), 3) << "seed " << seed;
    }
}

// Quartzes 50 ppm apart: phases pass each other every few minutes.
TEST(ReleaseTime, followsDisplaysThatDriftAgainstEachOther) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        UnlockedDisplays displays(seed, {60.003, 60.0, 59.997});
        playMinute(displays, true);
        EXPECT_LT(displays.worstSpread(), kSpreadOfThree) << "seed " << seed;
        EXPECT_LE(displays.irregular(), 6) << "seed " << seed;  // one or two changes of gap
    }
}

TEST(ReleaseTime, withoutPhasesFramesDoMixInTheSameSimulation) {
    UnlockedDisplays displays(1, {59.94, 59.94, 59.94});
    playMinute(displays, false);
    EXPECT_GT(displays.worstSpread(), kSpreadOfThree);
    EXPECT_GT(displays.irregular(), 0);
}

TEST(ReleaseTime, isOneRefreshAfterTheLastWhereNoDisplayTellsItsPhase) {
    EXPECT_EQ(releaseTime(at(105), at(100), kRefresh, {}), at(100) + kRefresh);
    EXPECT_EQ(releaseTime(at(130), at(100), kRefresh, {}), at(130));
}

// Blanks at 0 and 4 ms of each 16: the gap is from 5 to 15.
TEST(ReleaseTime, isTheFirstMomentInTheWidestGap) {
    const std::vector<net::Blanks> displays{{at(160), milliseconds(16)},
                                            {at(164), milliseconds(16)}};
    const auto release = [&](int earliest, int last) {
        return releaseTime(at(earliest), at(last), kRefresh, displays);
    };
    EXPECT_EQ(release(161, 149), at(165));  // waits for the gap
    EXPECT_EQ(release(168, 149), at(168));  // is in it
    EXPECT_EQ(release(176, 149), at(181));  // is past it
    EXPECT_EQ(release(168, 166), at(181));  // this gap has its frame
}

TEST(RecentTimes, giveQuantilesOfTheLastTenSeconds) {
    RecentTimes times;
    EXPECT_EQ(times.quantileMs(0.5), 0.0F);
    for (int ms = 1000; ms > 0; --ms) times.add(std::chrono::milliseconds(ms));
    EXPECT_NEAR(times.quantileMs(0.0), 1.0F, 1e-3F);
    EXPECT_NEAR(times.quantileMs(0.5), 300.0F, 1.0F);  // of 1 .. 600
    EXPECT_NEAR(times.quantileMs(1.0), 600.0F, 1e-3F);
}

TEST(SkewMeter, measuresLatestMinusEarliestOfEachFrameInAnyOrder) {
    SkewMeter meter;
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        meter.add({frame}, at(2));
        meter.add({frame}, at(5));
        if (frame > 0) meter.add({frame - 1}, at(1));  // a late report
    }
    EXPECT_FLOAT_EQ(meter.skews().quantileMs(0.5), 4.0F);
}

TEST(SkewMeter, oneNodeAloneHasNoSkew) {
    SkewMeter meter;
    for (std::uint64_t frame = 0; frame < 20; ++frame) meter.add({frame}, at(7));
    EXPECT_EQ(meter.skews().quantileMs(1.0), 0.0F);
}

}  // namespace
}  // namespace aquarama::conductor
