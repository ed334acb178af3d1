// SPDX-License-Identifier: Apache-2.0
// Records a show as it goes: every input with its tick, and now and then a hash of the world.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/simulation/simulation_decorator.h"

namespace aquarama::simulation {

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

}  // namespace aquarama::simulation
