// SPDX-License-Identifier: Apache-2.0
// What the motor step reads of a species: about 70 kB, of which a steady school touches 36.
#pragma once

#include <array>
#include <cstdint>

#include "common/motion/gait_path.h"
#include "common/motion/motor.h"
#include "common/motion/orientation.h"
#include "common/motion/repertoire.h"

namespace aquarama {

inline constexpr unsigned kPhaseCellBits = 10;  // a phase of 16 bits is 6 of cell, 10 of fraction
inline constexpr float kPhaseCellUnit = 1.0F / 1024.0F;

// The body frame at a phase as seen from phase 0; body lengths.
struct alignas(32) PathSample {
    Quaternion rotation;
    std::array<float, 4> translation{};  // the fourth is padding
};

// How the cycle-mean frame goes on at a phase, at the recorded rate, in a tick (for motion warps).
struct alignas(32) GlideSample {
    Quaternion bodyFromMean;
    std::array<float, 3> halfTurn{};
    float forward = 0.0F;  // body lengths
};

// How to go from a segment, within a cell of its phases, to another.
struct WarpPlan {
    std::uint16_t entryPhase = 0;
    std::uint8_t frames = 0;  // K, interpolated frames between the last pose and the first
};

struct SegmentTables {
    std::array<PathSample, kPathSamples> path;
    std::array<GlideSample, kCycleSamples> glide;
    std::array<Quaternion, kCycleSamples> bodyFromMean;
    std::array<std::array<WarpPlan, kActions>, kPhases> warpTo;
    float inversePhaseRate = 0.0F;
    float speedBodyLengths = 0.0F;  // a second
    float turnRate = 0.0F;          // radians a second, left positive
    std::uint16_t phaseRate = 0;    // as recorded
    bool playsToEnd = false;
};

class MotorTables {
  public:
    std::array<SegmentTables, kActions> segments;
};

}  // namespace aquarama
