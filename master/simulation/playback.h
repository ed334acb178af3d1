// SPDX-License-Identifier: Apache-2.0
// Replays a recording: the same inputs reach the world at the same ticks, and it is compared with
// what it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/simulation/simulation_decorator.h"

namespace aquarama::simulation {

// Where a replay first was another world than the recorded one.
struct Difference {
    Tick tick;
    std::uint64_t recorded = 0, replayed = 0;
    std::optional<Tick> lastSame;  // without: it never was the same
};

class Playback {
  public:
    // `recording` outlives it; `world` is at tick 0.
    Playback(const wire::Recording& recording, conductor::Simulation& world);

    void advance();  // by one tick, with what reached the world before it
    [[nodiscard]] bool over() const { return world_.tick() >= recording_.lastTick(); }
    [[nodiscard]] std::size_t inputs() const { return nextInput_; }  // that have reached the world
    [[nodiscard]] std::size_t compared() const { return compared_; }
    [[nodiscard]] const std::optional<Difference>& difference() const { return difference_; }

  private:
    void compare();
    void compareWith(const wire::RecordedHash& expected);

    const wire::Recording& recording_;
    conductor::Simulation& world_;
    std::size_t nextInput_ = 0, nextCheckpoint_ = 0, compared_ = 0;
    std::optional<Tick> lastSame_;
    std::optional<Difference> difference_;
};

// The replay as the conductor shows it. What visitors do meanwhile does not reach the world.
class ReplayedWorld final : public SimulationDecorator {
  public:
    // onEnd is called once, from the tick thread, when all that was recorded has been replayed.
    ReplayedWorld(const wire::Recording& recording,
                  conductor::Simulation& world,
                  std::function<void()> onEnd);

    void advance() override;
    void apply(const world::WorldInput& input) override;

  private:
    Playback playback_;
    std::function<void()> onEnd_;
    bool toldOfInput_ = false, toldOfDifference_ = false, ended_ = false;
};

}  // namespace aquarama::simulation
