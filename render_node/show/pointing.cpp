// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/pointing.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "common/wall/wall.h"
#include "render_node/project/projection.h"

namespace aquarama::show {

namespace {

constexpr float kArmMetres = 2.5F;          // of the submarine's, so that it is well in view
constexpr float kLeastDepthMetres = 0.25F;  // food is dropped into water, not into the air

}  // namespace

std::optional<glm::vec3> Pointing::directionOf(glm::vec2 pixel, const wire::Eye& eye) const {
    const glm::vec2 own = project::pixelOfEye(mode_, channel_.sizePixels, pixel);
    const auto point = wall::screenPoint(screen_, channel_, glm::dvec2(own));
    if (!point) return std::nullopt;
    return eye.worldFromWall * glm::vec3(glm::normalize(*point - sweetSpot_));
}

std::optional<glm::vec3> Pointing::pinchAt(glm::vec2 pixel, const wire::Eye& eye) const {
    const auto direction = directionOf(pixel, eye);
    if (!direction) return std::nullopt;
    const glm::vec3 viewer = eye.positionMetres + eye.worldFromWall * glm::vec3(sweetSpot_);
    glm::vec3 place = viewer + *direction * kArmMetres;
    place.y = std::min(place.y, -kLeastDepthMetres);
    return place;
}

}  // namespace aquarama::show
