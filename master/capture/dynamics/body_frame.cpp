// SPDX-License-Identifier: Apache-2.0
#include "master/capture/dynamics/body_frame.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama::capture {

// The paper takes origin and lateral axis from one diagonal and one edge of ring 2, which show the
// ring's own shear as a bob and a roll of some degrees; the means of both diagonals and both edges
// do not. And y is made a unit vector, since x is not quite square to that axis.
PoseFrame frameOf(const NodeVectors& pose) {
    const glm::dvec3 origin = (pose[5] + pose[6] + pose[7] + pose[8]) / 4.0;
    const glm::dvec3 right = (pose[6] - pose[5]) + (pose[7] - pose[8]);
    const glm::dvec3 x = glm::normalize(pose[0] - origin);
    const glm::dvec3 y = glm::normalize(glm::cross(right, x));
    return {origin, {x, y, glm::cross(x, y)}};
}

NodeVectors inBodyFrame(const NodeVectors& pose) {
    const PoseFrame frame = frameOf(pose);
    const glm::dmat3 bodyFromWorld = glm::transpose(frame.worldFromBody);
    NodeVectors body{};
    for (std::size_t i = 0; i < pose.size(); ++i)
        body.at(i) = bodyFromWorld * (pose.at(i) - frame.origin);
    return body;
}

}  // namespace aquarama::capture
