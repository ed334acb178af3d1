// SPDX-License-Identifier: Apache-2.0
// The living world behind the conductor's interface, and its construction from files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/config/scene.h"
#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/world/world.h"

namespace aquarama::simulation {

// A world::World behind the conductor's interface. Called from the tick thread only.
class LivingWorld : public conductor::Simulation {
  public:
    // Throws Error where the options make no world.
    explicit LivingWorld(const world::WorldOptions& options);
    void advance() override { world_.advance(); }
    void apply(const world::WorldInput& input) override { world_.apply(input); }
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] conductor::Snapshot snapshot() const override;
    [[nodiscard]] conductor::Explanation explain(std::uint32_t fish) const override;
    [[nodiscard]] bool followsHall() const override {
        return world_.surroundings().climate.day.followsHall;
    }
    [[nodiscard]] std::vector<conductor::DrawingSlots> drawingSlots() const override;
    [[nodiscard]] std::vector<conductor::Hunter> hunters() const override;
    [[nodiscard]] std::vector<school::RecordedRates> recordedRates() const override {
        return rates_;
    }

    // Goes on from a save: world::restore().
    void restore(std::span<const std::byte> state, const std::string& source) {
        world::restore(world_, state, source);
    }
    // The world itself, for measurements.
    [[nodiscard]] const world::World& world() const { return world_; }

  private:
    world::World world_;
    // Names of the species, in the order of the cast.
    std::vector<std::string> species_;
    std::vector<school::RecordedRates> rates_;
};

// Construction from files. The files are read once, as bytes. A show, its replay and a study make
// the same world from the same bytes.

// Choices of the command line beside the scene.
struct AssetChoice {
    std::uint32_t seed = 1;
    // Number of fish of the first species, instead of the scene's.
    std::optional<std::uint32_t> fish;
    // Species of which fish wait for visitors' drawings, and how many drawings swim at most.
    std::vector<std::string> drawnSpecies = {};
    std::uint32_t mostDrawings = 0;
    bool drawingsMayBeEaten = false;
    // Called with the progress of long work, as "capturing 3 of 7 species, 20 %"; by several
    // threads, but never two at once. May be empty.
    std::function<void(const std::string&)> tell = {};
};

// The parsed files of a show.
struct Assets {
    // The files as bytes, for the recording and the nodes.
    wire::AssetBundle bytes;
    // The scene, with the numbers of fish of the cast in the bytes.
    config::Scene scene;
    // The species of the cast, in its order.
    std::vector<config::Species> species;
};

// Reads the scene and the files of its cast. A species that is new on this machine is simulated
// first, which takes minutes and shows a progress bar. Throws Error with file:line:column.
[[nodiscard]] Assets readAssets(const std::string& scenePath, const AssetChoice& choice);

// Options of a world from its files. The number of threads suits the number of fish. Throws Error
// where a repertoire is wrong.
[[nodiscard]] world::WorldOptions worldOptionsOf(const Assets& assets);
// The same for a recording: parses its files first, and throws Error where one is wrong.
[[nodiscard]] world::WorldOptions worldOptionsOf(const wire::AssetBundle& recorded);

}  // namespace aquarama::simulation
