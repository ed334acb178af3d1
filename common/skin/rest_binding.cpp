// SPDX-License-Identifier: Apache-2.0
#include "common/skin/rest_binding.h"

#include <cmath>

#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "common/body/cage_topology.h"

namespace aquarama::skin {

namespace {

std::uint32_t tubePoint(int ring, int column) {
    return static_cast<std::uint32_t>(ring * body::kTubeColumns + column);
}

int ringNear(const body::ControlCage& cage, float station) {
    constexpr int kFlank = 3;
    int nearest = 1;
    const auto distance = [&](int ring) {
        return std::abs(cage.vertices[tubePoint(ring, kFlank)].rest.x - station);
    };
    for (int ring = 2; ring < body::kBodyEndRing; ++ring)
        if (distance(ring) < distance(nearest)) nearest = ring;
    return nearest;
}

}  // namespace

// Both flanks a ring before, back and belly a ring behind: never in one plane.
RestBinding::RestBinding(const body::ControlCage& cage, float station) {
    const int ring = ringNear(cage, station);
    points_ = {tubePoint(ring - 1, 3),
               tubePoint(ring - 1, 10),
               tubePoint(ring + 1, 0),
               tubePoint(ring + 1, 6)};
    glm::mat4 restFromWeights{1.0F};
    for (int k = 0; k < 4; ++k)
        restFromWeights[k] =
            glm::vec4(cage.vertices[points_.at(static_cast<std::size_t>(k))].rest, 1);
    weightsFromRest_ = glm::inverse(restFromWeights);
}

RestBinding::Weights RestBinding::ofPlace(glm::vec3 rest) const {
    const glm::vec4 w = weightsFromRest_ * glm::vec4(rest, 1);
    return {w.x, w.y, w.z, w.w};
}

RestBinding::Weights RestBinding::ofDirection(glm::vec3 direction) const {
    const glm::vec4 w = weightsFromRest_ * glm::vec4(direction, 0);
    return {w.x, w.y, w.z, w.w};
}

}  // namespace aquarama::skin
