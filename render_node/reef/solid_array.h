// SPDX-License-Identifier: Apache-2.0
// Immutable textures with the filters that the scene uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render_node/gl/handle.h"
#include "render_node/reef/mesh.h"
#include "render_node/water/water_tables.h"

namespace aquarama::scene {

enum class Edge : std::uint8_t { Clamp, Repeat };

// levels > 1: trilinear.
[[nodiscard]] gl::Texture makeTexture(GLenum format, glm::ivec2 size, int levels, Edge edge);
// A table as RGBA16F, an array where it has layers.
[[nodiscard]] gl::Texture makeTexture(const Table& table);
// One that is read smoothly between its layers, too.
[[nodiscard]] gl::Texture makeVolume(const Table& table);
void refill(const gl::Texture& texture, const Table& table);
[[nodiscard]] gl::Framebuffer makeTarget(const gl::Texture& colour);

// Fine relief of sand and rock, painted once on tiles that repeat: slopes and albedo for the
// shaders.

inline constexpr int kDetailTexels = 512;  // of a tile's side

struct Tile {
    std::vector<glm::u8vec4> values;  // slope x and z (0.5 is level), albedo, hollow to crest

    auto arrays() { return std::tie(values); }
};

// Painted once on a machine: derived data.
[[nodiscard]] Tile sandTile();
[[nodiscard]] Tile rockTile();

// How SolidVertex lies in a vertex array, and detail tiles in textures.

// Fills the two buffers with a mesh and names them in the array.
void setSolids(const gl::VertexArray& array,
               gl::Buffer& vertices,
               gl::Buffer& indices,
               const std::vector<SolidVertex>& meshVertices,
               const std::vector<std::uint32_t>& meshIndices);
[[nodiscard]] gl::Texture makeTexture(const Tile& tile);

// Draws take the place of their first index as a pointer.
[[nodiscard]] inline const void* byteOffset(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace aquarama::scene
