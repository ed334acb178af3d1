// SPDX-License-Identifier: Apache-2.0
// Textures, tiles of fine relief and vertex arrays, as the scene uses them.
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

// How a texture continues beyond its edge.
enum class Edge : std::uint8_t { Clamp, Repeat };

// An empty immutable texture with bilinear filtering, trilinear where it has several levels.
[[nodiscard]] gl::Texture makeTexture(GLenum format, glm::ivec2 size, int levels, Edge edge);
// A table as RGBA16F; a 2D array where it has several layers, which are not interpolated.
[[nodiscard]] gl::Texture makeTexture(const Table& table);
// A table as a 3D texture, which is also interpolated between its layers.
[[nodiscard]] gl::Texture makeVolume(const Table& table);
// Uploads a table of the same size into a texture that was made for one.
void refill(const gl::Texture& texture, const Table& table);
// A framebuffer that draws into level 0 of the texture.
[[nodiscard]] gl::Framebuffer makeTarget(const gl::Texture& colour);

// Fine relief of sand and rock on tiles that repeat.

// One tile, row by row.
struct Tile {
    // In 255ths: slope along x and z (0.5 is level, 0 and 1 are -1 and 1), albedo (0.5 is the
    // mean), height from hollow 0 to crest 1.
    std::vector<glm::u8vec4> values;

    // All arrays, for the cache of derived data.
    auto arrays() { return std::tie(values); }
};

// Take the tile from the cache of derived data, or compute it once on this machine.
[[nodiscard]] Tile sandTile();
[[nodiscard]] Tile rockTile();

// Vertex arrays of SolidVertex, and tiles as textures.

// Fills the two buffers with a mesh and attaches them to the array: attributes 0 to 3 are the
// members of SolidVertex.
void setSolids(const gl::VertexArray& array,
               gl::Buffer& vertices,
               gl::Buffer& indices,
               const std::vector<SolidVertex>& meshVertices,
               const std::vector<std::uint32_t>& meshIndices);
// Attaches a buffer of CoarseVertex: attributes kCoarseAttribute and the two after it.
void attachCoarse(const gl::VertexArray& array, const gl::Buffer& coarse);
[[nodiscard]] gl::Texture makeTexture(const Tile& tile);

// GL's draw calls take an offset in a buffer as a pointer.
[[nodiscard]] inline const void* byteOffset(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace aquarama::scene
