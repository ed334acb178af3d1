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

namespace aquarama {

// Where a replay first was another world than the recorded one.
struct Difference {
    Tick tick;
    std::uint64_t recorded = 0, replayed = 0;
    std::optional<Tick> lastSame;  // without: it never was the same
};

class Playback {
  public:
    // `recording` outlives it; `world` is at tick 0.
    Playback(const Recording& recording, Simulation& world);

    void advance();  // by one tick, with what reached the world before it
    [[nodiscard]] bool over() const { return world_.tick() >= recording_.lastTick(); }
    [[nodiscard]] std::size_t inputs() const { return nextInput_; }  // that have reached the world
    [[nodiscard]] std::size_t compared() const { return compared_; }
    [[nodiscard]] const std::optional<Difference>& difference() const { return difference_; }

  private:
    void compare();
    void compareWith(const RecordedHash& expected);

    const Recording& recording_;
    Simulation& world_;
    std::size_t nextInput_ = 0, nextCheckpoint_ = 0, compared_ = 0;
    std::optional<Tick> lastSame_;
    std::optional<Difference> difference_;
};

// The replay as the conductor shows it. What visitors do meanwhile does not reach the world.
class ReplayedWorld final : public Simulation {
  public:
    // onEnd is called once, from the tick thread, when all that was recorded has been replayed.
    ReplayedWorld(const Recording& recording, Simulation& world, std::function<void()> onEnd);

    void advance() override;
    void apply(const WorldInput& input) override;
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    void records(std::vector<FishRecord>& fish) const override { world_.records(fish); }
    void food(FoodCloud& cloud) const override { world_.food(cloud); }
    [[nodiscard]] Eye eye() const override { return world_.eye(); }
    [[nodiscard]] float daylight() const override { return world_.daylight(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] Explanation explain(std::uint32_t fish) const override {
        return world_.explain(fish);
    }

  private:
    Simulation& world_;
    Playback playback_;
    std::function<void()> onEnd_;
    bool toldOfInput_ = false, toldOfDifference_ = false, ended_ = false;
};

}  // namespace aquarama
