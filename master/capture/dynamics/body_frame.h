// SPDX-License-Identifier: Apache-2.0
// The body frame B of a pose (the paper's eq. 1-5), with the remedies that make it orthonormal and
// steady.
#pragma once

#include <glm/mat3x3.hpp>

#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama::capture {

struct PoseFrame {
    glm::dvec3 origin{};
    glm::dmat3 worldFromBody{1};  // columns: x anterior, y dorsal, z right
};

[[nodiscard]] PoseFrame frameOf(const NodeVectors& pose);
[[nodiscard]] NodeVectors inBodyFrame(const NodeVectors& pose);  // eq. 8

}  // namespace aquarama::capture
