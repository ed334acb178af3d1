// SPDX-License-Identifier: Apache-2.0
// What a segment does when it is replayed, in the numbers by which fish are compared.
#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "common/motion/repertoire.h"
#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama::capture {

// A phase in the frame of the fish's body at the start of the first cycle; body lengths.
struct ReplayedPhase {
    glm::dvec3 origin{};
    glm::dquat worldFromBody{1, 0, 0, 0};
    NodeVectors nodes{};
};

// Nodal points in the body frame at a phase of any cycle; body lengths.
[[nodiscard]] NodeVectors poseAt(const motion::ActionSegment& segment, std::size_t phase);

// kPhases phases a cycle and the end of the last one.
[[nodiscard]] std::vector<ReplayedPhase> replay(const motion::ActionSegment& segment, int cycles);

struct SegmentMeasures {
    double periodSeconds = 0;
    double strideBodyLengths = 0;  // way of the body frame's origin in a cycle, without its sway
    double speedBodyLengths = 0;   // a second
    double turnRadians = 0;        // in a cycle, left positive
    double turnRate = 0;           // radians a second
    double tailAmplitude = 0;      // peak to peak, across the course, body lengths
    double noseAmplitude = 0;
    double strouhal = 0;     // beat frequency * tail amplitude / speed
    double leanRadians = 0;  // what a cycle adds to roll and pitch together
    double climb = 0;        // body lengths in a cycle
    double largestStep =
        0;  // of any nodal point in the body frame, body lengths in a tick of 1/60 s
};
[[nodiscard]] SegmentMeasures measure(const motion::ActionSegment& segment);

}  // namespace aquarama::capture
