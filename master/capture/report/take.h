// SPDX-License-Identifier: Apache-2.0
// A segment as a take, the form in which programs for motion capture exchange data: places of all
// nodal points frame by frame, at the length of the recorded fish.
#pragma once

#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/repertoire.h"
#include "master/capture/measure.h"

namespace aquarama::report {

// The fish at one instant. Metres, right-handed, Y up. The fish starts at the origin, level, and
// heads along +x.
struct TakeFrame {
    double seconds = 0;
    glm::dvec3 origin{};                   // of the body frame
    glm::dquat worldFromBody{1, 0, 0, 0};  // rotation of the body frame
    capture::NodeVectors nodes{};          // in the world
};

struct Take {
    std::string species;
    std::string segment;      // as motion::nameOf() names it
    double lengthMetres = 0;  // of the recorded fish
    std::vector<TakeFrame> frames;
};

inline constexpr std::size_t kMostFrames = 65535;  // C3D counts frames in 16 bits
inline constexpr int kMostCycles = 1000;           // that the command line accepts

// Both play `cycles` >= 1 cycles from phase 0, as replayAlongX() does, and interpolate linearly
// between the 64 phases of a cycle (rotations along the great circle).

// Frames at the ticks of 1/60 s within the cycles. Throws Error for more than kMostFrames.
[[nodiscard]] Take takeAtTicks(const motion::Repertoire& repertoire,
                               motion::Action action,
                               int cycles);
// Frames at framesPerCycle evenly spaced phases of each cycle, and at the end of the last one.
[[nodiscard]] Take takeAtPhases(const motion::Repertoire& repertoire,
                                motion::Action action,
                                int cycles,
                                int framesPerCycle);

}  // namespace aquarama::report
