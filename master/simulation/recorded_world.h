// SPDX-License-Identifier: Apache-2.0
// What recorder and playback have in common: another simulation stands behind them and is seen
// through them; they differ in how it advances and in what reaches it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/world/events.h"

namespace aquarama::simulation {

class SimulationDecorator : public conductor::Simulation {
  public:
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    void records(std::vector<motion::FishRecord>& fish) const override { world_.records(fish); }
    void food(wire::FoodCloud& cloud) const override { world_.food(cloud); }
    [[nodiscard]] wire::Eye eye() const override { return world_.eye(); }
    [[nodiscard]] float daylight() const override { return world_.daylight(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] wire::Explanation explain(std::uint32_t fish) const override {
        return world_.explain(fish);
    }

  protected:
    explicit SimulationDecorator(conductor::Simulation& world) : world_(world) {}
    conductor::Simulation& world_;
};

// Records a show as it goes: every input with its tick, and now and then a hash of the world.

inline constexpr std::uint64_t kTicksBetweenCheckpoints = 600;

// Throws Error where there is a file already.
void requireNewRecording(const std::string& path);

// A recording that grows. Every entry reaches the system at once: whatever ends the program, the
// file is whole up to its last entry.
class RecordingFile {
  public:
    // Throws Error where there is such a file already, and where it cannot be written.
    RecordingFile(std::string path, const wire::AssetBundle& assets);

    // A show does not end because a disk is full: the first entry that cannot be written is
    // reported, and nothing is recorded from then on.
    void add(const wire::Packet& entry);
    [[nodiscard]] bool recording() const { return file_.is_open(); }

  private:
    std::string path_;
    std::ofstream file_;
};

// A world whose inputs are recorded. They reach it as its next tick begins, here as in a replay, so
// that no snapshot tells the two apart.
class RecordedWorld final : public SimulationDecorator {
  public:
    RecordedWorld(conductor::Simulation& world, RecordingFile& file);
    ~RecordedWorld() override;  // writes the end
    RecordedWorld(const RecordedWorld&) = delete;
    RecordedWorld& operator=(const RecordedWorld&) = delete;

    void advance() override;
    void apply(const world::WorldInput& input) override { pending_.push_back(input); }

  private:
    [[nodiscard]] wire::RecordedHash now() const { return {world_.tick(), world_.hash()}; }

    RecordingFile& file_;
    std::vector<world::WorldInput> pending_;
};

// Replays a recording: the same inputs reach the world at the same ticks, and it is compared with
// what it was.

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

// What reaches the world, as a recording has it, and back.

[[nodiscard]] wire::RecordedInput recorded(Tick tick, const world::WorldInput& input);
[[nodiscard]] world::WorldInput inputOf(const wire::RecordedInput& recorded);

}  // namespace aquarama::simulation
