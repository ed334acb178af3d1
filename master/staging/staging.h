// SPDX-License-Identifier: Apache-2.0
// From a scene's file to a world, and to what the nodes are sent of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/scene.h"
#include "common/net/channels.h"
#include "master/world/world.h"

namespace aquarama {

// One species of the cast: what moves it, and what the nodes are sent.
struct StagedSpecies {
    WorldSpecies species;
    ByteVector speciesBlob, repertoireBlob;
};

struct Staging {
    Scene scene;
    std::vector<StagedSpecies> cast;  // as the scene's
};

// Reads the scene and its species; those that never swam on this machine are captured, with a bar
// on the terminal. `fish` replaces the number of the first member. Throws Error with
// file:line:column.
[[nodiscard]] Staging stageScene(const std::string& scenePath, std::optional<std::uint32_t> fish);

// A member of a cast whose file and repertoire have been read already. Throws Error with
// source:line:column.
[[nodiscard]] StagedSpecies stagedSpecies(const std::string& text,
                                          const std::string& source,
                                          ByteVector repertoire,
                                          const CastMember& member);

[[nodiscard]] WorldOptions worldOptionsOf(const Staging& staging, std::uint32_t seed);

}  // namespace aquarama
