// SPDX-License-Identifier: Apache-2.0
#include "master/capture/body_frame.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama {

// The paper takes its lateral axis from the dorsal edge n5-n6 alone, which shows the shear of the
// ring as a roll of some degrees; the mean of both edges does not. And y is made a unit vector,
// since x is not quite square to that axis.
PoseFrame frameOf(const NodeVectors& pose) {
    const glm::dvec3 origin = (pose[5] + pose[7]) / 2.0;
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

}  // namespace aquarama
