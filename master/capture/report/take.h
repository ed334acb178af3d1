// SPDX-License-Identifier: Apache-2.0
// A segment as the programs of motion capture want it: a take of the recorded fish.
#pragma once

#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/repertoire.h"
#include "master/capture/measure.h"

namespace aquarama::report {

// Metres, right-handed, Y up. The fish starts at the origin, level, and heads along +x.
struct TakeFrame {
    double seconds = 0;
    glm::dvec3 origin{};  // of the body frame
    glm::dquat worldFromBody{1, 0, 0, 0};
    capture::NodeVectors nodes{};
};

struct Take {
    std::string species;
    std::string segment;
    double lengthMetres = 0;
    std::vector<TakeFrame> frames;
};

inline constexpr std::size_t kMostFrames = 65535;  // as many as a C3D file can count
inline constexpr int kMostCycles = 1000;

// Some cycles from phase 0, as replayAlongX() plays them; between the 64 phases of a cycle
// everything goes straight.
// At the ticks of 1/60 s within the cycles. Throws Error for more than kMostFrames.
[[nodiscard]] Take takeAtTicks(const motion::Repertoire& repertoire,
                               motion::Action action,
                               int cycles);
// At so many phases of each cycle, and at the end of the last.
[[nodiscard]] Take takeAtPhases(const motion::Repertoire& repertoire,
                                motion::Action action,
                                int cycles,
                                int framesPerCycle);

}  // namespace aquarama::report
