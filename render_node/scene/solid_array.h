// SPDX-License-Identifier: Apache-2.0
// How SolidVertex lies in a vertex array, and detail tiles in textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render_node/gl/handle.h"
#include "render_node/scene/detail_tiles.h"
#include "render_node/scene/mesh.h"

namespace aquarama::scene {

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
