// SPDX-License-Identifier: Apache-2.0
// The picture while the master is silent, and when it is heard again, over the fish of a living
// world: all nodes show the same, no fish jumps, none ends in a rock, and in the end each is where
// the master has it.
#include "render_node/session/dead_reckoning.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/motion/reconstruct.h"
#include "common/place/contact.h"
#include "master/conductor/school_stream.h"
#include "master/simulation/living_world.h"
#include "render_node/session/convergence.h"
#include "tests/master/world/lively_worlds.h"
#include "tests/master/world/node_motion.h"

namespace aquarama::session {
namespace {

constexpr double kHertz = 60;
// Of the master's clock, a second in.
constexpr net::Moment kBegin{std::chrono::seconds(1000)};

net::Moment momentOf(std::uint64_t frame) {
    return kBegin + std::chrono::round<net::Duration>(
                        std::chrono::duration<double>(static_cast<double>(frame) / kHertz));
}

// The places of all fish in a picture; those that are away are left out.
std::map<std::size_t, glm::vec3> placesIn(const wire::StateFrame& frame) {
    std::map<std::size_t, glm::vec3> places;
    for (std::size_t fish = 0; fish < frame.after.size(); ++fish) {
        const motion::FishRecord& after = frame.after[fish];
        const motion::FishRecord& before = frame.before.empty() ? after : frame.before[fish];
        if (isAway(before) || isAway(after)) continue;
        places[fish] = motion::present(before, after, frame.fraction, {}).positionMetres;
    }
    return places;
}

// The longest way of a fish from one picture to the next, metres.
float longestStep(const wire::StateFrame& from, const wire::StateFrame& to) {
    const auto before = placesIn(from), after = placesIn(to);
    float longest = 0;
    for (const auto& [fish, place] : after) {
        const auto was = before.find(fish);
        if (was != before.end()) longest = std::max(longest, glm::distance(place, was->second));
    }
    return longest;
}

void expectSame(const wire::StateFrame& left, const wire::StateFrame& right) {
    EXPECT_EQ(left.tick, right.tick);
    EXPECT_EQ(left.fraction, right.fraction);
    EXPECT_EQ(left.after, right.after) << left.frame.value;
    EXPECT_EQ(left.before, right.before) << left.frame.value;
}

// What one node has.
struct Node {
    SchoolFollower follower{[](const v1::Envelope&) {}};
    std::shared_ptr<school::SchoolMotion> motion;
    DeadReckoning reckoning;

    wire::StateFrame take(const wire::CodedState& coded) {
        follower.take(coded, kBegin);
        wire::StateFrame frame = follower.next().value().state;
        EXPECT_TRUE(frame.areOfTick);
        reckoning.saw(frame);
        return frame;
    }
    void begin(DeadReckoning::Cause cause = DeadReckoning::Cause::Silence) {
        reckoning.begin(cause, follower, motion);
    }
    wire::StateFrame at(std::uint64_t frame) {
        wire::StateFrame due = reckoning.due(momentOf(frame - 2)).value().state;
        EXPECT_FALSE(due.areOfTick);
        return due;
    }
};

// A master whose frame n shows the middle between ticks n - 1 and n, and two nodes.
class Silence : public testing::Test {
  protected:
    Silence() : options_(world::optionsFor("reef_1998")), world_(options_) {
        stream_.begin(world_.recordedRates());
        for (Node* node : {&left_, &right_}) {
            node->motion = world::nodeMotion(options_, world_.world());
            node->follower.use(1, node->motion);
        }
        stream_.add(world_.snapshot());
        show(600);
    }
    wire::CodedState advance() {
        world_.advance();
        const conductor::Snapshot snapshot = world_.snapshot();
        stream_.add(snapshot);
        wire::CodedState coded;
        coded.frame.frame = {snapshot.tick.value};
        coded.frame.tick = snapshot.tick;
        coded.frame.fraction = 0.5F;
        coded.frame.show.look = 1;
        coded.school = stream_.upTo(snapshot.tick);
        return coded;
    }
    // The master shows so many frames to both; gives the longest step.
    float show(int frames) {
        float longest = 0;
        for (int i = 0; i < frames; ++i) {
            const wire::CodedState coded = advance();
            wire::StateFrame next = left_.take(coded);
            right_.take(coded);
            for (Node* node : {&left_, &right_})
                node->reckoning.released(next.frame, momentOf(next.frame.value));
            if (last_) longest = std::max(longest, longestStep(*last_, next));
            last_ = std::move(next);
        }
        return longest;
    }
    std::uint64_t shown() const { return last_->frame.value; }

    world::WorldOptions options_;
    simulation::LivingWorld world_;
    conductor::SchoolStream stream_;
    Node left_, right_;
    std::optional<wire::StateFrame> last_;
};

TEST_F(Silence, allNodesMakeTheSameFrames) {
    show(10);
    left_.begin();
    right_.begin();
    ASSERT_TRUE(left_.reckoning.isOn() && right_.reckoning.isOn());
    const std::uint64_t first = shown() + DeadReckoning::kSilent + 1;
    EXPECT_FALSE(left_.reckoning.due(momentOf(first - 3))) << "it is too early";
    for (std::uint64_t frame = first; frame < first + 400; ++frame) {
        // The left one is slow, and makes every third frame.
        const wire::StateFrame right = right_.at(frame);
        EXPECT_EQ(right.frame.value, frame);
        const auto instant = right_.reckoning.release({frame});
        ASSERT_TRUE(instant);
        EXPECT_LE(std::chrono::abs(instant->at - momentOf(frame)), std::chrono::nanoseconds(2));
        if (frame % 3 == 0) expectSame(left_.at(frame), right);
    }
    EXPECT_FALSE(left_.reckoning.release({shown()})) << "the master's";
}

// It begins a frame earlier, and is a quarter of a frame ahead until both are in time.
TEST_F(Silence, aNodeThatMissedTheLastReleaseSoonMakesTheSameFrames) {
    show(10);
    const wire::CodedState last = advance();
    left_.take(last);
    right_.take(last);
    left_.reckoning.released(last.frame.frame, momentOf(last.frame.frame.value));
    left_.begin();
    right_.begin();
    for (std::uint64_t after = DeadReckoning::kSilent + 1; after < 200; ++after) {
        const wire::StateFrame left = left_.at(last.frame.frame.value + after);
        const wire::StateFrame right = right_.at(last.frame.frame.value + after);
        const auto worldOf = [](const wire::StateFrame& frame) {
            return static_cast<float>(frame.tick.value) + frame.fraction;
        };
        EXPECT_LE(std::abs(worldOf(right) - worldOf(left)), 0.26F);
        if (after > 80) expectSame(left, right);
    }
}

TEST_F(Silence, noFishJumpsAndTheWorldIsInTimeAfterASecond) {
    const float longest = show(600);
    left_.begin();
    wire::StateFrame before = *last_;
    const std::uint64_t first = shown() + DeadReckoning::kSilent + 1;
    for (std::uint64_t frame = first; frame < first + 1200; ++frame) {
        const wire::StateFrame next = left_.at(frame);
        const bool isBehind = frame < first + 60;
        EXPECT_LE(longestStep(before, next), (isBehind ? 1.25F : 1.0F) * longest + 0.001F) << frame;
        if (!isBehind) {
            EXPECT_EQ(next.tick.value, frame);
            EXPECT_NEAR(next.fraction, 0.5F, 1e-4F);
        }
        before = next;
    }
}

TEST_F(Silence, whereTheMasterHandsOverThePictureDoesNotEvenPause) {
    const float longest = show(600);
    // The frame that is on its way was not released.
    const wire::CodedState coded = advance();
    wire::StateFrame before = left_.take(coded);
    left_.begin(DeadReckoning::Cause::HandOver);
    const auto instant = left_.reckoning.release(before.frame);
    ASSERT_TRUE(instant);
    EXPECT_EQ(instant->at, momentOf(before.frame.value));
    for (int frame = 1; frame < 60; ++frame) {
        const std::uint64_t number = coded.frame.frame.value + static_cast<std::uint64_t>(frame);
        const wire::StateFrame next = left_.at(number);
        EXPECT_EQ(next.tick.value, number);
        EXPECT_LE(longestStep(before, next), longest + 0.001F) << frame;
        before = next;
    }
}

TEST_F(Silence, fishThatAreAloneForAMinuteSwimLevelAndStayInTheirWater) {
    show(10);
    left_.begin();
    wire::StateFrame frame;
    for (std::uint64_t i = 1; i < 3600; ++i) frame = left_.at(shown() + DeadReckoning::kSilent + i);
    const place::Obstacles& obstacles = world_.world().surroundings().obstacles;
    const auto traits = world_.world().traits();
    const auto began = placesIn(*last_);
    for (const auto& [fish, place] : placesIn(frame)) {
        const float halfWidth = 0.06F * static_cast<float>(traits[fish].lengthMillimetres) * 0.001F;
        // Pushed out at forty times the depth a second: 5 cm at the most.
        EXPECT_LT(glm::length(place::contactVelocity(obstacles, place, halfWidth)), 1.99F) << fish;
        const motion::BodyFrame body = motion::bodyFrameOf(frame.after[fish]);
        const bool hovers = staysInPlace(motion::actionOf(frame.after[fish].segment));
        if (!hovers) {
            EXPECT_LT(std::abs((body.rotation * glm::vec3{1, 0, 0}).y), 0.3F)
                << fish << " plays " << frame.after[fish].segment;
        }
        EXPECT_LT(std::abs(place.y - began.at(fish).y), 1.5F) << fish;
        // A circle of 2.5 m, two seconds straight on, and what the tide adds in a minute.
        EXPECT_LT(glm::distance(place, began.at(fish)), 9) << fish;
    }
}

TEST_F(Silence, fishGlideToWhereTheMasterHasThem) {
    const float longest = show(600);
    left_.begin();
    const std::uint64_t silent = 150;
    wire::StateFrame before = *last_;
    std::vector<wire::CodedState> missed;
    for (std::uint64_t frame = 1; frame <= silent; ++frame) {
        missed.push_back(advance());
        if (frame > DeadReckoning::kSilent) before = left_.at(shown() + frame);
    }
    // It is heard again; what was lost comes with it.
    for (const wire::CodedState& coded : missed) left_.follower.take(coded, kBegin);
    while (left_.follower.next()) {
    }
    Convergence convergence;
    float off = 0;
    int jumped = 0;
    for (int frame = 0; frame < 500; ++frame) {
        const wire::StateFrame masters = left_.take(advance());
        if (frame == 0) {
            const wire::StateFrame reckoned = left_.reckoning.next().state;
            ASSERT_EQ(reckoned.frame, masters.frame);
            ASSERT_EQ(reckoned.tick, masters.tick);
            off = longestStep(reckoned, masters);
            convergence.begin(reckoned, masters);
        }
        wire::StateFrame shown = masters;
        convergence.apply(shown);
        if (shown.after != masters.after) {
            EXPECT_FALSE(shown.areOfTick) << frame;
        }
        if (frame >= 490) {
            EXPECT_TRUE(shown.areOfTick) << frame;
        }
        for (const motion::FishRecord& record : shown.after) ASSERT_TRUE(isPlayable(record));
        const auto was = placesIn(before);
        for (const auto& [fish, place] : placesIn(shown)) {
            if (!was.contains(fish)) continue;
            const float step = glm::distance(place, was.at(fish));
            // Farther than three metres off it is shown where it is.
            if (frame == 0 && step > 2.9F)
                ++jumped;
            else
                EXPECT_LE(step, longest + 0.6F / 60 + 0.001F) << fish << " in frame " << frame;
        }
        if (frame >= 481) {
            EXPECT_EQ(shown.after, masters.after) << frame;
        }
        before = shown;
    }
    EXPECT_GT(off, 0.1F) << "or nothing was tried";
    EXPECT_LE(jumped, 2);
}

TEST_F(Silence, aFrozenWorldStandsStill) {
    show(10);
    wire::CodedState coded = advance();
    coded.frame.show.frozen = true;
    const wire::StateFrame frozen = left_.take(coded);
    left_.reckoning.released(frozen.frame, momentOf(frozen.frame.value));
    left_.begin();
    const wire::StateFrame later = left_.at(frozen.frame.value + 100);
    EXPECT_EQ(later.tick, frozen.tick);
    EXPECT_EQ(later.after, frozen.after);
}

TEST_F(Silence, withoutAFrameThatWasShownThereIsNothingToGoOnFrom) {
    Node fresh;
    fresh.motion = left_.motion;
    fresh.begin();
    EXPECT_FALSE(fresh.reckoning.isOn());
    EXPECT_FALSE(fresh.reckoning.due(momentOf(1)));
}

}  // namespace
}  // namespace aquarama::session
