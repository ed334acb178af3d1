// SPDX-License-Identifier: Apache-2.0
// A segment as a take, the form in which programs for motion capture exchange data: places of all
// nodal points frame by frame, at the length of the recorded fish; and its files of other programs:
// C3D, the exchange format of motion capture, and CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "capture/measure.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// The fish at one instant. Metres, right-handed, Y up. The fish starts at the origin, level, and
// heads along +x.
struct TakeFrame {
    double seconds = 0;
    glm::dvec3 origin{};                   // of the body frame
    glm::dquat worldFromBody{1, 0, 0, 0};  // rotation of the body frame
    capture::NodeVectors nodes{};          // in the world
};

// A recording of one fish, frame by frame.
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

// The names of the 23 nodal points, which are the markers of a take.

// `node` is 0 to 22, in the order of biomechanical_fish.h.
// "NOSE", "R1_DL" .. "R5_VL" (ring, dorsal or ventral, left or right), "TAIL_D", "TAIL_V".
[[nodiscard]] std::string markerLabel(std::size_t node);
// "nodal point 1, ring 1 of 5, dorsal left"
[[nodiscard]] std::string markerDescription(std::size_t node);

// A take as comma-separated values: a row for each frame, below a row with the name and unit of
// each column, "time_s,n0_x_m,n0_y_m,n0_z_m,n1_x_m,...". Columns are the 23 nodal points of the
// paper's Fig. 1. Numbers are the shortest decimals that give the same float, with a decimal point
// in every locale.
[[nodiscard]] std::string csvOf(const Take& take);

// A take as a C3D file (The C3D File Format User Guide, Motion Lab Systems 2008). Each nodal point
// is a marker, in metres, Y up: Intel byte order, floating-point data, no analogue channels.
// POINT:X_SCREEN is +X and POINT:Y_SCREEN +Y. At most kMostFrames frames.
[[nodiscard]] std::vector<std::byte> c3dOf(const Take& take);

}  // namespace aquarama::report
