// SPDX-License-Identifier: Apache-2.0
// Fine relief of sand and rock, painted once on tiles that repeat: slopes and albedo for the
// shaders.
#pragma once

#include <tuple>
#include <vector>

#include <glm/gtc/type_precision.hpp>

namespace aquarama::scene {

inline constexpr int kDetailTexels = 512;  // of a tile's side

struct Tile {
    std::vector<glm::u8vec4> values;  // slope x and z (0.5 is level), albedo, hollow to crest

    auto arrays() { return std::tie(values); }
};

// Painted once on a machine: derived data.
[[nodiscard]] Tile sandTile();
[[nodiscard]] Tile rockTile();

}  // namespace aquarama::scene
