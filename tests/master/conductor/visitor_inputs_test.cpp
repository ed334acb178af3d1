// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/visitor_inputs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/master/conductor/parts.h"
#include "tests/support/messages.h"
#include "tests/support/stage.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

v1::Input food(float metresAhead) {
    return test::dropFood(test::CountingWorld::kFoodOrigin + glm::vec3(0, 0, -metresAhead)).input();
}

// Visitors of a world that has come to its last tick, and only does what it is told.
class Visitors : public testing::Test {
  protected:
    Visitors() { inputs.enter(&thread, 3); }
    // The world after all that it was told: what it is told is done in the order given.
    Snapshot told() {
        std::promise<Snapshot> promise;
        if (!thread.betweenTicks(
                [&](const Simulation& told) { promise.set_value(told.snapshot()); }))
            throw std::runtime_error("too many jobs wait");
        return promise.get_future().get();
    }
    std::ptrdiff_t pellets() {
        return std::ranges::count(told().food.particles,
                                  wire::FoodRecord::Kind::Pellet,
                                  [](const wire::FoodRecord& record) { return record.kind(); });
    }

    test::Parts parts;
    std::atomic<int> wakes = 0;
    VisitorInputs inputs{parts.sender, [this] { ++wakes; }};
    wire::Eye eye{.positionMetres = test::CountingWorld::kFoodOrigin};
    net::Moment now = test::kStart;
    test::CountingWorld world;
    SimulationThread thread{world, wire::Pace::Lockstep, Tick{0}, [] {}};
};

TEST_F(Visitors, foodIsDroppedWhereItCanBeReached) {
    EXPECT_FALSE(inputs.feed("visitor 1", food(9), eye, now));
    EXPECT_EQ(pellets(), 0);
    EXPECT_TRUE(inputs.feed("visitor 1", food(7), eye, now)) << "what is refused is not counted";
    EXPECT_EQ(pellets(), 1);
}

// Who gives more has done nothing wrong: it is ignored, not counted as refused.
TEST_F(Visitors, eachFeedsFiveTimesASecondAtMost) {
    for (const int ms : {0, 100, 199, 200, 399}) {
        EXPECT_TRUE(inputs.feed("visitor 1", food(1), eye, now + milliseconds(ms)));
        EXPECT_TRUE(inputs.feed("visitor 2", food(1), eye, now + milliseconds(ms)));
    }
    EXPECT_EQ(pellets(), 4) << "two of each";
    EXPECT_TRUE(inputs.feed(parts.join("left"), food(1), eye, now + milliseconds(399)));
    EXPECT_EQ(pellets(), 5) << "a window is another one";
    EXPECT_TRUE(inputs.feed(parts.seat("left"), food(1), eye, now + milliseconds(400)));
    EXPECT_EQ(pellets(), 5);
}

TEST_F(Visitors, theLastWhoTakesHoldSteers) {
    EXPECT_FALSE(inputs.pilot(now));
    EXPECT_TRUE(inputs.steer("a window", wire::steeringInput({.ahead = 5}), now));
    EXPECT_EQ(inputs.pilot(now), "a window");
    EXPECT_EQ(told().eye.positionMetres.z, -5);
    EXPECT_TRUE(inputs.steer("a terminal", wire::steeringInput({.ahead = 9}), now));
    EXPECT_EQ(inputs.pilot(now), "a terminal");
    EXPECT_TRUE(inputs.steer("a window", wire::steeringInput({.ahead = 5}), now));
    EXPECT_EQ(told().eye.positionMetres.z, -9) << "the other one still holds on";
    EXPECT_FALSE(inputs.pilot(now + std::chrono::seconds(1))) << "both are silent";
}

TEST_F(Visitors, aMindIsExplainedToTheOneWhoAsks) {
    EXPECT_TRUE(inputs.ask("a terminal", 2));
    told();
    EXPECT_EQ(wakes, 1);
    EXPECT_TRUE(parts.sent.empty()) << "it is the conductor that sends";
    inputs.answer();
    ASSERT_EQ(parts.sent.size(), 1U);
    EXPECT_EQ(parts.sent[0].peer, "a terminal");
    const v1::Explanation& mind = parts.sent[0].message.explanation();
    EXPECT_EQ(mind.fish(), 2U);
    EXPECT_EQ(mind.school(), 3U);
    EXPECT_EQ(mind.tick(), 0U);
    ASSERT_EQ(mind.lines_size(), 1);
    EXPECT_EQ(mind.lines(0), "at tick 0");
    inputs.answer();
    EXPECT_EQ(parts.sent.size(), 1U) << "once";
}

TEST_F(Visitors, nothingIsPassedOnWithoutAWorld) {
    inputs.enter(nullptr, 3);
    EXPECT_TRUE(inputs.feed("visitor 1", food(1), eye, now));
    EXPECT_TRUE(inputs.steer("a terminal", wire::steeringInput({.ahead = 5}), now));
    EXPECT_TRUE(inputs.ask("a terminal", 2));
    EXPECT_FALSE(inputs.pilot(now));
    EXPECT_EQ(pellets(), 0);
    EXPECT_EQ(told().eye.positionMetres.z, 0);
    inputs.answer();
    EXPECT_TRUE(parts.sent.empty());
}

}  // namespace
}  // namespace aquarama::conductor
