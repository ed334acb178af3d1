// SPDX-License-Identifier: Apache-2.0
// What the motor step reads of a species: about 60 kB, of which a steady school touches 36.
#pragma once

#include <array>
#include <cstdint>

#include "common/motion/gait_path.h"
#include "common/motion/motor.h"
#include "common/motion/orientation.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {

inline constexpr unsigned kPhaseCellBits = 10;  // a phase of 16 bits is 6 of cell, 10 of fraction
inline constexpr float kPhaseCellUnit = 1.0F / 1024.0F;

// The body frame at a phase as seen from phase 0, in body lengths; and how fast the path is there:
// speed units for each unit of phase rate. Swimming, that is the mean of the cycle at every phase.
struct alignas(32) PathSample {
    Quaternion rotation;
    std::array<float, 4> translationAndSpeed{};
};

// How to go from a segment, within a cell of its phases, to another.
struct WarpPlan {
    std::uint16_t entryPhase = 0;
    std::uint8_t frames = 0;  // K, interpolated frames between the last pose and the first
};

struct SegmentTables {
    std::array<PathSample, kPathSamples> path;
    std::array<Quaternion, kCycleSamples> bodyFromMean;
    std::array<std::array<WarpPlan, kActions>, kPhases> warpTo;
    float speedBodyLengths = 0.0F;  // a second
    float turnRate = 0.0F;          // radians a second, left positive
    std::int16_t phaseRate = 0;     // as recorded
    bool playsToEnd = false;
};

// By how many speed units the speed changes in a tick: SpeedResponse in the motor's units.
struct SpeedLoss {
    // For each square of a unit, while a segment plays; 1 where no response was measured, so that
    // the speed follows at once.
    std::array<float, kActions> drag{};
    float brake = 0.0F;  // for each unit, of wholly spread fins
};

class MotorTables {
  public:
    std::array<SegmentTables, kActions> segments;
    // The recorded phase rate of what plays to its end, 0 of the others.
    std::array<std::int32_t, kActions> turnRate{};
    SpeedLoss loss;
};

}  // namespace aquarama::motion
