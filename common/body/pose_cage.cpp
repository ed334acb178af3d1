// SPDX-License-Identifier: Apache-2.0
#include <cassert>

#include <glm/geometric.hpp>

#include "common/body/fish_body.h"
#include "common/body/spine.h"

namespace aquarama::body {

namespace {

glm::vec3 place(const Spine& spine, glm::vec3 rest) {
    const SpineSample sample = sampleAt(spine, rest.x);
    const glm::vec3 forward = -glm::normalize(sample.tailwards);
    const glm::vec3 right =
        glm::normalize(sample.right - forward * glm::dot(sample.right, forward));
    return sample.centre + rest.y * glm::cross(right, forward) + rest.z * right;
}

}  // namespace

void poseCage(const FishBody& body, const NodalPoints& nodes, std::span<glm::vec3> controlPoints) {
    assert(controlPoints.size() == body.cage.vertices.size());
    const Spine spine = spineOf(knotStations(body), nodes);
    for (std::size_t i = 0; i < controlPoints.size(); ++i)
        controlPoints[i] = place(spine, body.cage.vertices[i].rest);
}

}  // namespace aquarama::body
