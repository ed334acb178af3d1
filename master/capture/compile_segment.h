// SPDX-License-Identifier: Apache-2.0
// An action as the simulation swam it: nodal points in the world at each phase.
#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"
#include "master/capture/biomechanical_fish.h"

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

// From a recording to an action segment: body-frame increments, deformations and control points
// (the paper's eq. 6-9), closed so that it can be repeated for ever.

// Without control points. All throw Error where a fish reaches further than its own length.
[[nodiscard]] motion::ActionSegment compileForward(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compileLeftTurn(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compileRightTurn(const RecordedCycle& leftTurn);

// Eq. 9: those of each phase's nodal points.
void addControlPoints(const body::FishBody& body, motion::ActionSegment& segment);

}  // namespace aquarama::capture
