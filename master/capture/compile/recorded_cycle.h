// SPDX-License-Identifier: Apache-2.0
// An action as the simulation swam it: nodal points in the world at each phase.
#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "common/motion/repertoire.h"
#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama::capture {

struct RecordedCycle {
    double periodSeconds = 0;
    bool playsToEnd = false;
    glm::dvec3 course{1, 0, 0};  // where it swam: over the beat, or over the last one before a turn
    std::vector<NodeVectors>
        poses;  // at phases 0 .. kPhases, in body lengths: one more than kPhases
};

// About the vertical, left positive.
[[nodiscard]] inline double yawRadians(const glm::dvec3& from, const glm::dvec3& to) {
    return std::atan2(glm::cross(from, to).y, glm::dot(from, to));
}

}  // namespace aquarama::capture
