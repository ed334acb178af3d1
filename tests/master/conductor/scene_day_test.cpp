// SPDX-License-Identifier: Apache-2.0
// What a world is told of the time of day that is wanted, and of the hall's clock.
#include "master/conductor/scene_day.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/day.h"
#include "common/wire/wanted_show.h"
#include "master/conductor/hall_clock.h"

namespace aquarama::conductor {
namespace {

using std::chrono::seconds;
using v1::WantedShow;

// A world that keeps what it is told of its day.
class ToldWorld final : public Simulation {
  public:
    explicit ToldWorld(bool followsHall) : followsHall_{followsHall} {}
    void advance() override { ++tick_.value; }
    void apply(const world::WorldInput& input) override {
        const std::lock_guard lock(mutex_);
        if (const auto* day = std::get_if<world::SetDay>(&input)) days_.push_back(*day);
        if (std::holds_alternative<world::SetClock>(input)) ++clocks_;
    }
    Tick tick() const override { return tick_; }
    std::uint64_t hash() const override { return 0; }
    Snapshot snapshot() const override {
        return {.tick = tick_, .eye = {}, .fish = {}, .food = {}};
    }
    Explanation explain(std::uint32_t /*fish*/) const override { return {}; }
    bool followsHall() const override { return followsHall_; }

    std::vector<world::SetDay> days() const {
        const std::lock_guard lock(mutex_);
        return days_;
    }
    int clocks() const {
        const std::lock_guard lock(mutex_);
        return clocks_;
    }

  private:
    bool followsHall_;
    Tick tick_;
    mutable std::mutex mutex_;
    std::vector<world::SetDay> days_;
    int clocks_ = 0;
};

TEST(SceneDay, phasesAreNamedAsThoseOfThePlaceAndKeptInTheirMiddle) {
    for (int phase = 0; phase < int{place::kDayPhases}; ++phase) {
        const auto which = static_cast<place::DayPhase>(phase);
        const auto day = wire::dayNamed(place::nameOf(which));
        ASSERT_TRUE(day) << place::nameOf(which);
        EXPECT_EQ(timeWantedBy(*day), place::timeIn(which, 0.5));
    }
    EXPECT_FALSE(timeWantedBy(WantedShow::CLOCK));
    EXPECT_EQ(wire::dayName(WantedShow::CLOCK), "clock");
}

class WantedDay : public testing::Test {
  protected:
    // Waits until the jobs that were given are done.
    void settle(SimulationThread& thread) {
        std::atomic<bool> isDone = false;
        ASSERT_TRUE(thread.betweenTicks([&](Simulation&) { isDone = true; }));
        while (!isDone) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    SceneDay day{""};
    net::Moment now = net::monotonicNow();
};

TEST_F(WantedDay, isAtOnceInANewWorldAndGlidesInARunningOne) {
    ToldWorld world(false);
    day.begin(world, WantedShow::DUSK, now);
    ASSERT_EQ(world.days().size(), 1U);
    EXPECT_EQ(world.days()[0].timeOfDay, timeWantedBy(WantedShow::DUSK));
    EXPECT_EQ(world.days()[0].glideSeconds, 0);
    SimulationThread thread(world, wire::Pace::Live, {}, [] {});
    day.turn(thread, WantedShow::DUSK, now);
    day.turn(thread, WantedShow::NOON, now + seconds(1));
    day.turn(thread, WantedShow::NOON, now + seconds(2));
    day.turn(thread, WantedShow::CLOCK, now + seconds(3));
    settle(thread);
    ASSERT_EQ(world.days().size(), 3U);
    EXPECT_EQ(world.days()[1].timeOfDay, timeWantedBy(WantedShow::NOON));
    EXPECT_EQ(world.days()[1].glideSeconds, kDayGlideSeconds);
    EXPECT_FALSE(world.days()[2].timeOfDay);
    EXPECT_EQ(world.clocks(), 0) << "it follows no hall";
}

TEST_F(WantedDay, goesBeforeTheHallsClockWhichIsSetWhereItTakesOver) {
    ToldWorld world(true);
    day.begin(world, WantedShow::CLOCK, now);
    EXPECT_EQ(world.clocks(), 1);
    EXPECT_TRUE(world.days().empty());
    SimulationThread thread(world, wire::Pace::Live, {}, [] {});
    day.turn(thread, WantedShow::CLOCK, now + seconds(kClockCorrectionSeconds));
    settle(thread);
    EXPECT_EQ(world.clocks(), 2);
    day.turn(thread, WantedShow::NIGHT, now + seconds(kClockCorrectionSeconds + 1));
    day.turn(thread, WantedShow::NIGHT, now + seconds(3 * kClockCorrectionSeconds));
    settle(thread);
    EXPECT_EQ(world.clocks(), 2) << "nobody sees it";
    day.turn(thread, WantedShow::CLOCK, now + seconds(3 * kClockCorrectionSeconds + 1));
    day.turn(thread, WantedShow::CLOCK, now + seconds(3 * kClockCorrectionSeconds + 2));
    settle(thread);
    EXPECT_EQ(world.clocks(), 3);
    EXPECT_EQ(world.days().size(), 2U);
}

}  // namespace
}  // namespace aquarama::conductor
