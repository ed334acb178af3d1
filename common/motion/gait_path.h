// SPDX-License-Identifier: Apache-2.0
// Where one cycle of a segment takes the body frame, in doubles and without libm: what the motor's
// tables are made of.
#pragma once

#include <array>
#include <cstddef>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/repertoire.h"

namespace aquarama::motion {

inline constexpr std::size_t kPathSamples = 2 * kPhases + 1;
inline constexpr std::size_t kCycleSamples = kPhases + 1;  // the last repeats the first

// How the cycle-mean frame moves at a phase, in its own axes and in 1/64 of a cycle.
struct MeanMotion {
    glm::dvec3 halfTurn{};  // tangent of half the angle, along the axis
    double forward = 0.0;   // body lengths
};

struct GaitPath {
    // The body frame at phase k as seen from phase 0, over two cycles: a tick that runs over the
    // end of a cycle then needs no case of its own.
    std::array<glm::dquat, kPathSamples> rotation{};
    std::array<glm::dvec3, kPathSamples> translation{};  // body lengths
    // From body axes to the cycle-mean frame, which the tail beat does not sway: it points where
    // the fish goes.
    std::array<glm::dquat, kCycleSamples> bodyFromMean{};
    std::array<MeanMotion, kCycleSamples> mean{};
};

[[nodiscard]] GaitPath pathOf(const ActionSegment& segment);

}  // namespace aquarama::motion
