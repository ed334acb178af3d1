// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/simulation_thread.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include <gtest/gtest.h>

#include "master/conductor/meters.h"
#include "master/conductor/status.h"
#include "tests/support/stage.h"

namespace aquarama::conductor {
namespace {

Snapshot next(SimulationThread& simulationThread) {
    while (true) {  // the suite's budget would stop it
        if (auto snapshot = simulationThread.take()) return *snapshot;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
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
    while (calls < 31) std::this_thread::yield();
    EXPECT_FALSE(simulationThread.take());
    EXPECT_EQ(world.tick(), Tick{30});
}

TEST(SimulationThread, lockstepRunsNoFurtherAheadThanAFewTicks) {
    test::CountingWorld world;
    std::atomic<int> calls = 0;
    {
        const SimulationThread simulationThread(world, wire::Pace::Lockstep, {}, [&] { ++calls; });
        while (calls < 4) std::this_thread::yield();
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

TEST(SimulationThread, aPausePutsOffAllThatIsDue) {
    test::CountingWorld world;
    SimulationThread simulationThread(world, wire::Pace::Live, {}, [] {});
    next(simulationThread);
    simulationThread.togglePause();
    EXPECT_TRUE(simulationThread.paused());
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    while (simulationThread.take()) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    EXPECT_FALSE(simulationThread.take());
    const net::Instant resumed = net::monotonicNow();
    simulationThread.togglePause();
    EXPECT_GE(next(simulationThread).due, resumed);
}

// A job that notes the tick at which it was called.
void askAndExpectAnAnswer(SimulationThread& simulationThread) {
    std::atomic<bool> answered = false;
    ASSERT_TRUE(simulationThread.betweenTicks([&](Simulation& world) {
        EXPECT_EQ(world.hash(), test::CountingWorld::hashAt(world.tick()));
        answered = true;
    }));
    while (!answered) std::this_thread::yield();  // the suite's budget would stop it
}

TEST(SimulationThread, doesJobsWhileItRunsWhileItIsPausedAndWhileNobodyTakesItsTicks) {
    test::CountingWorld world;
    SimulationThread live(world, wire::Pace::Live, {}, [] {});
    askAndExpectAnAnswer(live);
    live.togglePause();
    askAndExpectAnAnswer(live);

    test::CountingWorld other;
    SimulationThread lockstep(other, wire::Pace::Lockstep, {}, [] {});
    while (other.tick().value < SnapshotBuffer::kKept / 2) std::this_thread::yield();
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
    while (!holding) std::this_thread::yield();
    int accepted = 0;
    while (simulationThread.betweenTicks([&, job = accepted](Simulation&) {
        order.push_back(job);
        ++done;
    }))
        ++accepted;
    EXPECT_GE(accepted, 16);
    held = false;
    while (done < accepted) std::this_thread::yield();
    EXPECT_TRUE(std::ranges::is_sorted(order));
}

TEST(SimulationThread, endsWhileItWaits) {
    test::CountingWorld world;
    for (const wire::Pace pace : {wire::Pace::Live, wire::Pace::Lockstep}) {
        SimulationThread simulationThread(world, pace, {}, [] {});
        if (pace == wire::Pace::Live) simulationThread.togglePause();
    }
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
        meter.add({{frame}, 2'000'000});
        meter.add({{frame}, 5'000'000});
        if (frame > 0) meter.add({{frame - 1}, 1'000'000});  // a late report
    }
    EXPECT_FLOAT_EQ(meter.skews().quantileMs(0.5), 4.0F);
}

TEST(SkewMeter, oneNodeAloneHasNoSkew) {
    SkewMeter meter;
    for (std::uint64_t frame = 0; frame < 20; ++frame) meter.add({{frame}, 7});
    EXPECT_EQ(meter.skews().quantileMs(1.0), 0.0F);
}

TEST(Status, saysWhenNoMasterAnswers) {
    const auto free = net::bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*")->controlAddress();
    EXPECT_THROW(static_cast<void>(runStatus(free)), Error);
}

}  // namespace
}  // namespace aquarama::conductor
