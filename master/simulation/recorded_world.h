// SPDX-License-Identifier: Apache-2.0
// Recording and replaying a world. Both are decorators: they stand in front of another simulation
// and differ in how it advances and which inputs reach it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recording_file.h"
#include "master/world/events.h"

namespace aquarama::simulation {

// Passes every question on to another simulation, which it does not own and which outlives it.
class SimulationDecorator : public conductor::Simulation {
  public:
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] conductor::Snapshot snapshot() const override { return world_.snapshot(); }
    [[nodiscard]] conductor::Explanation explain(std::uint32_t fish) const override {
        return world_.explain(fish);
    }
    [[nodiscard]] bool followsHall() const override { return world_.followsHall(); }
    [[nodiscard]] std::vector<conductor::DrawingSlots> drawingSlots() const override {
        return world_.drawingSlots();
    }
    [[nodiscard]] std::vector<conductor::Hunter> hunters() const override {
        return world_.hunters();
    }
    [[nodiscard]] std::vector<school::RecordedRates> recordedRates() const override {
        return world_.recordedRates();
    }

  protected:
    // Stands before this simulation.
    explicit SimulationDecorator(conductor::Simulation& world) : world_(world) {}
    conductor::Simulation& world_;
};

// Recording: every input with its tick, a hash of the world from time to time, and now and then the
// whole of it.

// Ticks between two recorded hashes: ten seconds.
inline constexpr std::uint64_t kTicksBetweenCheckpoints = 600;

// Ticks between two saves of the whole world: a minute.
inline constexpr std::uint64_t kTicksBetweenSaves = 3600;

// A world whose inputs are recorded. An input waits until the next tick begins, here as in a
// replay, so that a snapshot between two ticks is the same in both.
class RecordedWorld final : public SimulationDecorator {
  public:
    // Records this world into this file; both outlive it.
    RecordedWorld(LivingWorld& world, RecordingFile& file);
    // Writes the end of the recording.
    ~RecordedWorld() override;
    RecordedWorld(const RecordedWorld&) = delete;
    RecordedWorld& operator=(const RecordedWorld&) = delete;

    void advance() override;
    void apply(const world::WorldInput& input) override { pending_.push_back(input); }

  private:
    // The present tick and hash.
    [[nodiscard]] wire::RecordedHash now() const { return {world_.tick(), world_.hash()}; }

    LivingWorld& living_;
    RecordingFile& file_;
    std::vector<world::WorldInput> pending_;
};

// Replaying: the same inputs reach the world at the same ticks, and its hashes are compared with
// the recorded ones.

// The first tick at which the hash of a replay differs from the recorded one.
struct Difference {
    Tick tick;
    std::uint64_t recorded = 0, replayed = 0;
    // The last tick before it with equal hashes, if any.
    std::optional<Tick> lastSame;
};

// Drives a world through a recording and compares hashes on the way.
class Playback {
  public:
    // Both outlive it; `world` is at tick 0. Throws Error where the recording begins with a save of
    // another build.
    Playback(const wire::Recording& recording, LivingWorld& world);

    // Goes forward to a tick, from the last save before it where that is nearer. Saves of another
    // build are passed over, with a warning.
    void goTo(Tick tick);
    // Advances by one tick, after the inputs recorded for it.
    void advance();
    [[nodiscard]] bool over() const { return world_.tick() >= recording_.lastTick(); }
    // Number of inputs applied, and of hashes compared, so far.
    [[nodiscard]] std::size_t inputs() const { return nextInput_; }
    [[nodiscard]] std::size_t compared() const { return compared_; }
    [[nodiscard]] const std::optional<Difference>& difference() const { return difference_; }

  private:
    // Puts the world where it was at a save. False: it is none of this build.
    [[nodiscard]] bool beginAt(const wire::RecordedSave& save);
    // Compares the present hash with every recorded one that is due.
    void compare();
    void compareWith(const wire::RecordedHash& expected);

    const wire::Recording& recording_;
    LivingWorld& world_;
    std::size_t nextInput_ = 0, nextCheckpoint_ = 0, compared_ = 0;
    std::optional<Tick> lastSame_;
    std::optional<Difference> difference_;
};

// The replay as the conductor shows it. Inputs of visitors are dropped, with one warning.
class ReplayedWorld final : public SimulationDecorator {
  public:
    // Begins at the tick `from`. `onEnd` is called once, from the tick thread, after the last
    // recorded tick.
    ReplayedWorld(const wire::Recording& recording,
                  LivingWorld& world,
                  Tick from,
                  std::function<void()> onEnd);

    void advance() override;
    void apply(const world::WorldInput& input) override;
    // Nothing reaches it, so it asks for nothing.
    [[nodiscard]] bool followsHall() const override { return false; }
    [[nodiscard]] std::vector<conductor::DrawingSlots> drawingSlots() const override { return {}; }
    [[nodiscard]] std::vector<conductor::Hunter> hunters() const override { return {}; }

  private:
    Playback playback_;
    std::function<void()> onEnd_;
    // Each warning is given once.
    bool toldOfInput_ = false, toldOfDifference_ = false, ended_ = false;
};

// Inputs as a recording stores them, and back.
[[nodiscard]] wire::RecordedInput recorded(Tick tick, const world::WorldInput& input);
[[nodiscard]] world::WorldInput inputOf(const wire::RecordedInput& recorded);

}  // namespace aquarama::simulation
