// SPDX-License-Identifier: Apache-2.0
// The world as the conductor knows it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/scene.h"
#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/world/world.h"

namespace aquarama::simulation {

class LivingWorld : public conductor::Simulation {
  public:
    explicit LivingWorld(const world::WorldOptions& options);
    void advance() override { world_.advance(); }
    void apply(const world::WorldInput& input) override { world_.apply(input); }
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    void records(std::vector<motion::FishRecord>& fish) const override { world_.records(fish); }
    void food(wire::FoodCloud& cloud) const override;
    [[nodiscard]] wire::Eye eye() const override;
    [[nodiscard]] float daylight() const override { return world_.surroundings().daylight; }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] wire::Explanation explain(std::uint32_t fish) const override;

    [[nodiscard]] const world::World& world() const { return world_; }

  private:
    world::World world_;
    std::vector<std::string> species_;  // their names, in the order of the cast
};

// From files to a world: what a show is made of is read once, as bytes, and the same bytes make the
// world of the show, of its replay and of a study.

// What the command line asks for.
struct AssetChoice {
    std::uint32_t seed = 1;
    std::optional<std::uint32_t> fish;  // of the first species, instead of the scene's number
};

// A show's files, each parsed once.
struct Assets {
    wire::AssetBundle bytes;               // as they are recorded, and sent to the nodes
    config::Scene scene;                   // with as many fish as the bytes' cast
    std::vector<config::Species> species;  // of the cast, in its order
};

// Reads the scene and the files of its cast; a species that was never shown on this machine is
// captured, behind a bar of progress. Throws Error with file:line:column.
[[nodiscard]] Assets readAssets(const std::string& scenePath, const AssetChoice& choice);

// Throws Error where a repertoire is wrong. Threads: as many as serve so many fish.
[[nodiscard]] world::WorldOptions worldOptionsOf(const Assets& assets);
// Of a recording: parses its files first, and throws Error where one is wrong, too.
[[nodiscard]] world::WorldOptions worldOptionsOf(const wire::AssetBundle& recorded);

}  // namespace aquarama::simulation
