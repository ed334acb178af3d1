// SPDX-License-Identifier: Apache-2.0
#include "render_node/project/projection_map.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "common/units/error.h"

namespace aquarama::project {

namespace {

glm::vec4 place(const glm::vec4& pointAndWeight, const wall::ChannelFrustum& frustum) {
    if (pointAndWeight.w <= 0) return glm::vec4(0);
    const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(glm::dvec3(pointAndWeight), 1);
    const glm::dvec2 tangent = glm::dvec2(seen) / -seen.z;
    const double u = (tangent.x - frustum.left) / (frustum.right - frustum.left);
    const double v = (tangent.y - frustum.bottom) / (frustum.top - frustum.bottom);
    return {u, v, pointAndWeight.w, 0};
}

}  // namespace

ProjectionMap projectionMap(const wall::WarpMap& warp, const wall::ChannelFrustum& frustum) {
    ProjectionMap map{.sizePixels = warp.sizePixels, .placeAndWeight = {}};
    map.placeAndWeight.reserve(warp.pointAndWeight.size());
    for (const glm::vec4& point : warp.pointAndWeight)
        map.placeAndWeight.push_back(place(point, frustum));
    return map;
}

glm::ivec2 scenePictureSize(const ProjectionMap& map) {
    if (map.sizePixels.x < 2 || map.sizePixels.y < 2)
        throw Error("channel: a picture of less than 2 x 2 pixels; give it the projector's size");
    const auto width = static_cast<std::size_t>(map.sizePixels.x);
    const std::size_t middle = static_cast<std::size_t>(map.sizePixels.y) / 2 * width + width / 2;
    const glm::vec4& at = map.placeAndWeight[middle];
    const glm::vec4& right = map.placeAndWeight[middle + 1];
    const glm::vec4& below = map.placeAndWeight[middle + width];
    if (at.z <= 0 || right.z <= 0 || below.z <= 0)
        throw Error(
            "channel: the middle of its picture misses the screen; aim its projector at it");
    // Along either axis of the frustum's picture, how far one step across the projector's goes.
    const glm::dvec2 acrossColumns = glm::dvec2(right) - glm::dvec2(at);
    const glm::dvec2 acrossRows = glm::dvec2(below) - glm::dvec2(at);
    return {std::ceil(1 / std::hypot(acrossColumns.x, acrossRows.x)),
            std::ceil(1 / std::hypot(acrossColumns.y, acrossRows.y))};
}

}  // namespace aquarama::project
