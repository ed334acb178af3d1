// SPDX-License-Identifier: Apache-2.0
// Fine relief of sand and rock, painted once on tiles that repeat: slopes and albedo for the
// shaders.
#pragma once

#include <vector>

#include <glm/gtc/type_precision.hpp>

namespace aquarama {

struct Tile {
    int texels = 0;
    std::vector<glm::u8vec4> values;  // slope x and z (0.5 is level), albedo, hollow to crest
};

inline constexpr float kSandTileMetres = 2.6F;  // as in floor.frag
inline constexpr float kRockTileMetres = 1.1F;  // as in rock.frag

[[nodiscard]] Tile sandTile();
[[nodiscard]] Tile rockTile();

}  // namespace aquarama
