// SPDX-License-Identifier: Apache-2.0
// For each pixel of a projector the place in its frustum's picture that it shows, computed once.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "common/wall/wall.h"

namespace aquarama::project {

struct ProjectionMap {
    glm::ivec2 sizePixels{};
    // Top row first: texture coordinate in the frustum's picture (origin at its bottom left),
    // blend weight, 0.
    std::vector<glm::vec4> placeAndWeight;
};

// The eye is the frustum's.
[[nodiscard]] ProjectionMap projectionMap(const wall::WarpMap& warp,
                                          const wall::ChannelFrustum& frustum);

// The size at which the frustum's picture is as fine as the projector's pixels are in the middle of
// its lit area. Away from there a flat picture of a concave screen only gets finer, as the tangent
// grows faster than the angle.
[[nodiscard]] glm::ivec2 scenePictureSize(const ProjectionMap& map);

}  // namespace aquarama::project
