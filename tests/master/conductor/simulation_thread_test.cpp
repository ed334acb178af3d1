// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/simulation_thread.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/ask/request_client.h"
#include "master/conductor/status_text.h"
#include "tests/support/await.h"
#include "tests/support/stage.h"

namespace aquarama::conductor {
namespace {

// The next snapshot. Throws std::bad_optional_access where none comes.
Snapshot next(SimulationThread& simulationThread) {
    std::optional<Snapshot> snapshot;
    EXPECT_TRUE(test::comesTrue([&] { return (snapshot = simulationThread.take()).has_value(); }));
    return snapshot.value();
}

TEST(SimulationThread, lockstepGivesEveryTickOnceAndStopsAtTheLast) {
    test::CountingWorld world;
    std::atomic<int> calls = 0;
    SimulationThread simulationThread(world, wire::Pace::Lockstep, Tick{30}, [&] { ++calls; });
    for (std::uint64_t tick = 0; tick <= 30; ++tick) {
        const Snapshot snapshot = next(simulationThread);
        EXPECT_EQ(snapshot.tick, Tick{tick});
        EXPECT_EQ(snapshot.hash, test::CountingWorld::hashAt({tick}));
        EXPECT_EQ(snapshot.fish.at(0).x, static_cast<int>(tick));
    }
    EXPECT_TRUE(test::comesTrue([&] { return calls >= 31; }));
    EXPECT_FALSE(simulationThread.take());
    EXPECT_EQ(world.tick(), Tick{30});
}

TEST(SimulationThread, lockstepRunsNoFurtherAheadThanAFewTicks) {
    test::CountingWorld world;
    std::atomic<int> calls = 0;
    {
        const SimulationThread simulationThread(world, wire::Pace::Lockstep, {}, [&] { ++calls; });
        EXPECT_TRUE(test::comesTrue([&] { return calls >= 4; }));
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_LE(world.tick().value, SnapshotBuffer::kKept);
}

TEST(SimulationThread, liveTicksAreDueOnePeriodApartWhateverTheirDelay) {
    test::CountingWorld world;
    SimulationThread simulationThread(world, wire::Pace::Live, {}, [] {});
    Snapshot last = next(simulationThread);
    for (int tick = 1; tick < 10; ++tick) {
        const Snapshot snapshot = next(simulationThread);
        EXPECT_EQ(snapshot.tick.value, last.tick.value + 1);
        if (snapshot.due != last.due + kTickPeriod) {
            // Only a machine that stood still for a quarter of a second may put it off.
            EXPECT_GT(snapshot.due - last.due, 15 * kTickPeriod);
        }
        last = snapshot;
    }
}

TEST(SimulationThread, aFreezePutsOffAllThatIsDue) {
    test::CountingWorld world;
    SimulationThread simulationThread(world, wire::Pace::Live, {}, [] {});
    next(simulationThread);
    simulationThread.freeze(true);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    while (simulationThread.take()) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    EXPECT_FALSE(simulationThread.take());
    const net::Moment resumed = net::monotonicNow();
    simulationThread.freeze(false);
    EXPECT_GE(next(simulationThread).due, resumed);
}

// A job that notes the tick at which it was called.
void askAndExpectAnAnswer(SimulationThread& simulationThread) {
    std::atomic<bool> answered = false;
    ASSERT_TRUE(simulationThread.betweenTicks([&](Simulation& world) {
        EXPECT_EQ(world.hash(), test::CountingWorld::hashAt(world.tick()));
        answered = true;
    }));
    EXPECT_TRUE(test::comesTrue([&] { return answered.load(); }));
}

TEST(SimulationThread, doesJobsWhileItRunsWhileItIsFrozenAndWhileNobodyTakesItsTicks) {
    test::CountingWorld world;
    SimulationThread live(world, wire::Pace::Live, {}, [] {});
    askAndExpectAnAnswer(live);
    live.freeze(true);
    askAndExpectAnAnswer(live);

    test::CountingWorld other;
    std::atomic<std::size_t> ticks = 0;
    SimulationThread lockstep(other, wire::Pace::Lockstep, {}, [&] { ++ticks; });
    EXPECT_TRUE(test::comesTrue([&] { return ticks >= SnapshotBuffer::kKept / 2; }));
    askAndExpectAnAnswer(lockstep);
}

TEST(SimulationThread, doesJobsAfterTheLastTick) {
    test::CountingWorld world;
    SimulationThread simulationThread(world, wire::Pace::Lockstep, Tick{0}, [] {});
    next(simulationThread);
    askAndExpectAnAnswer(simulationThread);
    EXPECT_EQ(world.tick(), Tick{0});
}

// Jobs run one after the other with the world, so they need no lock of their own.
TEST(SimulationThread, doesJobsInTheOrderGivenAndNoMoreThanItCan) {
    test::CountingWorld world;
    std::atomic<bool> holding = false, held = true;
    std::atomic<int> done = 0;
    std::vector<int> order;
    SimulationThread simulationThread(world, wire::Pace::Live, {}, [] {});
    ASSERT_TRUE(simulationThread.betweenTicks([&](Simulation&) {
        holding = true;
        while (held) std::this_thread::yield();
    }));
    ASSERT_TRUE(test::comesTrue([&] { return holding.load(); }));
    int accepted = 0;
    while (simulationThread.betweenTicks([&, job = accepted](Simulation&) {
        order.push_back(job);
        ++done;
    }))
        ++accepted;
    EXPECT_GE(accepted, 16);
    held = false;
    EXPECT_TRUE(test::comesTrue([&] { return done >= accepted; }));
    EXPECT_TRUE(std::ranges::is_sorted(order));
}

TEST(SimulationThread, endsWhileItWaits) {
    for (const wire::Pace pace : {wire::Pace::Live, wire::Pace::Lockstep}) {
        const auto world = std::make_shared<test::CountingWorld>();
        const auto ticks = std::make_shared<std::atomic<std::size_t>>();
        auto thread =
            std::make_unique<SimulationThread>(*world, pace, std::nullopt, [ticks] { ++*ticks; });
        // Live it waits because it is frozen, in lockstep because nobody takes its ticks.
        if (pace == wire::Pace::Live) thread->freeze(true);
        const std::size_t last = pace == wire::Pace::Live ? 1 : SnapshotBuffer::kKept / 2;
        ASSERT_TRUE(test::comesTrue([&] { return *ticks >= last; }));
        EXPECT_TRUE(test::ends([world, thread = std::move(thread)]() mutable { thread.reset(); }));
    }
}

TEST(RequestClient, saysWhenNoMasterAnswers) {
    const auto free = net::bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*")->controlAddress();
    EXPECT_THROW(static_cast<void>(ask::RequestClient(free).status()), Error);
}

constexpr net::Moment kBegin{std::chrono::seconds(100)};

// Midnight lies between ticks 2 and 3.
float timeOfDayAt(std::uint64_t tick) {
    return tick < 3 ? 0.9F + 0.04F * static_cast<float>(tick)
                    : 0.04F * static_cast<float>(tick) - 0.1F;
}

Snapshot at(std::uint64_t tick, net::Moment due) {
    return {{tick},
            due,
            tick * 10,
            {glm::vec3(static_cast<float>(tick), 0, 0), {1, 0, 0, 0}},
            timeOfDayAt(tick),
            {motion::FishRecord{.x = static_cast<std::int32_t>(tick)}},
            {{7, 8, 9}, {{tick}}}};
}

SnapshotBuffer ticks(std::uint64_t first, std::uint64_t last) {
    SnapshotBuffer snapshots;
    for (std::uint64_t tick = first; tick <= last; ++tick) {
        snapshots.add(at(tick, kBegin + static_cast<std::int64_t>(tick) * kTickPeriod));
    }
    return snapshots;
}

TEST(SnapshotBuffer, isEmptyBeforeTheFirstTick) {
    EXPECT_FALSE(SnapshotBuffer{}.showing({0}, kBegin));
    EXPECT_FALSE(SnapshotBuffer{}.showing({0}, Tick{0}));
    EXPECT_FALSE(SnapshotBuffer{}.newest());
}

TEST(SnapshotBuffer, lockstepShowsTheTickItself) {
    const SnapshotBuffer snapshots = ticks(0, 5);
    const auto state = snapshots.showing({9}, Tick{3});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->frame, Frame{9});
    EXPECT_EQ(state->tick, Tick{3});
    EXPECT_EQ(state->fraction, 1.0F);
    EXPECT_EQ(state->foodOriginMetres, glm::vec3(7, 8, 9));
    EXPECT_TRUE(state->foodBefore.empty());
    EXPECT_EQ(state->foodAfter[0].bits, 3U);
    EXPECT_EQ(state->timeOfDay, timeOfDayAt(3));
    EXPECT_EQ(state->worldHash, 30U);
    EXPECT_FALSE(snapshots.showing({9}, Tick{6}));
}

TEST(SnapshotBuffer, aMomentBetweenTwoTicksShowsBothAndTheFraction) {
    const SnapshotBuffer snapshots = ticks(0, 5);
    const auto state = snapshots.showing({1}, kBegin + 2 * kTickPeriod + kTickPeriod / 4);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->tick, Tick{3});
    EXPECT_NEAR(state->fraction, 0.25F, 1e-6F);
    EXPECT_NEAR(state->eye.positionMetres.x, 2.25F, 1e-5F);
    EXPECT_EQ(state->foodBefore[0].bits, 2U);
    EXPECT_EQ(state->foodAfter[0].bits, 3U);
    EXPECT_NEAR(state->timeOfDay, 0.99F, 1e-6F);
    const auto later = snapshots.showing({1}, kBegin + 2 * kTickPeriod + 3 * kTickPeriod / 4);
    ASSERT_TRUE(later);
    EXPECT_NEAR(later->timeOfDay, 0.01F, 1e-6F) << "past midnight";
}

TEST(SnapshotBuffer, aTicksOwnMomentShowsItAlone) {
    const SnapshotBuffer snapshots = ticks(0, 5);
    const auto state = snapshots.showing({1}, kBegin + 4 * kTickPeriod);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->tick, Tick{4});
    EXPECT_EQ(state->fraction, 1.0F);
}

TEST(SnapshotBuffer, momentsOutsideShowTheNearestTick) {
    EXPECT_EQ(ticks(3, 5).showing({1}, kBegin)->tick, Tick{3});
    EXPECT_EQ(ticks(3, 5).showing({1}, kBegin + std::chrono::seconds(100))->tick, Tick{5});
}

TEST(SnapshotBuffer, theWorldStandsStillThroughAPause) {
    SnapshotBuffer snapshots = ticks(0, 1);
    snapshots.add(at(2, kBegin + 600 * kTickPeriod));
    for (const int tick : {2, 300, 599}) {
        const auto state = snapshots.showing({1}, kBegin + tick * kTickPeriod);
        EXPECT_EQ(state->tick, Tick{1});
        EXPECT_EQ(state->fraction, 1.0F);
    }
    const auto state = snapshots.showing({1}, kBegin + 599 * kTickPeriod + kTickPeriod / 2);
    EXPECT_EQ(state->tick, Tick{2});
    EXPECT_NEAR(state->fraction, 0.5F, 1e-6F);
}

TEST(SnapshotBuffer, forgetsTheOldest) {
    const SnapshotBuffer snapshots = ticks(0, 100);
    EXPECT_FALSE(snapshots.showing({0}, Tick{100 - SnapshotBuffer::kKept}));
    EXPECT_TRUE(snapshots.showing({0}, Tick{101 - SnapshotBuffer::kKept}));
    EXPECT_EQ(snapshots.newest(), Tick{100});
}

}  // namespace
}  // namespace aquarama::conductor
