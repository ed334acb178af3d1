// SPDX-License-Identifier: Apache-2.0
// From files to a world: what a show is made of is read once, as bytes, and the same bytes make the
// world of the show, of its replay and of a study.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/scene.h"
#include "common/wire/recording.h"
#include "master/world/world.h"

namespace aquarama::simulation {

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
