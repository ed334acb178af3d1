// SPDX-License-Identifier: Apache-2.0
// What sand and reef have in common when they are drawn.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render_node/gl/handle.h"
#include "render_node/reef/solid_array.h"

namespace aquarama::scene {

// What a view of the place leaves out. Both are switched off only for maps of depth and for
// measurements.
struct PlaceRule {
    bool culling = true;
    bool levelsOfDetail = true;
};

// A draw, as glMultiDrawElementsIndirect reads it.
struct DrawCommand {
    std::uint32_t count = 0;
    std::uint32_t instanceCount = 0;
    std::uint32_t firstIndex = 0;
    std::int32_t baseVertex = 0;
    std::uint32_t baseInstance = 0;
};
static_assert(sizeof(DrawCommand) == 20);

// Draws the triangles of `count` commands of the indirect buffer that is bound, from the `first`.
inline void drawCommands(std::size_t first, GLsizei count) {
    glMultiDrawElementsIndirect(
        GL_TRIANGLES, GL_UNSIGNED_INT, byteOffset(first * sizeof(DrawCommand)), count, 0);
}

}  // namespace aquarama::scene
