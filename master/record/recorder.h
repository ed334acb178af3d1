// SPDX-License-Identifier: Apache-2.0
// Records a show as it goes: every input with its tick, and now and then a hash of the world.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "common/wire/recording.h"
#include "master/conductor/simulation.h"

namespace aquarama {

inline constexpr std::uint64_t kTicksBetweenCheckpoints = 600;

// A recording that grows. Every entry reaches the system at once: whatever ends the program, the
// file is whole up to its last entry.
class RecordingFile {
  public:
    // Throws Error where there is such a file already, and where it cannot be written.
    RecordingFile(std::string path, const Production& production);

    // A show does not end because a disk is full: the first entry that cannot be written is
    // reported, and nothing is recorded from then on.
    void add(const Packet& entry);
    [[nodiscard]] bool recording() const { return file_.is_open(); }

  private:
    std::string path_;
    std::ofstream file_;
};

// A world whose inputs are recorded. They reach it as its next tick begins, here as in a replay, so
// that no snapshot tells the two apart.
class RecordedWorld final : public Simulation {
  public:
    RecordedWorld(Simulation& world, RecordingFile& file);
    ~RecordedWorld() override;  // writes the end
    RecordedWorld(const RecordedWorld&) = delete;
    RecordedWorld& operator=(const RecordedWorld&) = delete;

    void advance() override;
    void apply(const WorldInput& input) override { pending_.push_back(input); }
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
    [[nodiscard]] RecordedHash now() const { return {world_.tick(), world_.hash()}; }

    Simulation& world_;
    RecordingFile& file_;
    std::vector<WorldInput> pending_;
};

}  // namespace aquarama
