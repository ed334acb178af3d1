// SPDX-License-Identifier: Apache-2.0
// Replays an action segment and measures it in the figures by which fish are compared. Lengths are
// body lengths. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "capture/biomechanical_fish.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

// The fish at one phase. The world is the body frame at the start of the first cycle.
struct ReplayedPhase {
    glm::dvec3 origin{};                   // of the body frame
    glm::dquat worldFromBody{1, 0, 0, 0};  // rotation of the body frame
    NodeVectors nodes{};                   // in the world
};

// Nodal points in the body frame at a phase, which is taken modulo kPhases.
[[nodiscard]] NodeVectors poseAt(const motion::ActionSegment& segment, std::size_t phase);

// `cycles` >= 1. The result has cycles * kPhases + 1 phases; the last is the end of the last cycle.
[[nodiscard]] std::vector<ReplayedPhase> replay(const motion::ActionSegment& segment, int cycles);

// The figures of one cycle.
struct SegmentMeasures {
    double periodSeconds = 0;
    double strideBodyLengths = 0;  // path of the body frame's origin in a cycle, without its sway
    double speedBodyLengths = 0;   // a second
    double turnRadians = 0;        // in a cycle, left positive
    double turnRate = 0;           // radians a second
    double tailAmplitude = 0;      // peak to peak, across the course, body lengths
    double noseAmplitude = 0;      // the same of the nose
    double strouhal = 0;           // beat frequency * tail amplitude / speed
    double leanRadians = 0;        // roll and pitch together that one cycle adds
    double climb = 0;              // body lengths in a cycle
    // The greatest motion of any nodal point in the body frame in a tick of 1/60 s, body lengths.
    double largestStep = 0;
};
[[nodiscard]] SegmentMeasures measure(const motion::ActionSegment& segment);

// As replay(), but in a world whose +x is the course; y is up, z to the right. The course of a
// cyclic segment is the mean over a cycle, since the tail beat makes the body frame sway. That of a
// turn that plays to its end is the heading at its start.
[[nodiscard]] std::vector<ReplayedPhase> replayAlongX(const motion::ActionSegment& segment,
                                                      int cycles);

// The wave that travels down a swimming fish: amplitude and phase of the lateral motion of each
// part of its body.

// The nose, the five rings, the middle of the tips of the tail.
inline constexpr std::size_t kWaveStations = 7;

// First harmonic of the motion across the course.
struct BodyWave {
    std::array<double, kWaveStations> stations{};    // mean distance from the nose, body lengths
    std::array<double, kWaveStations> amplitudes{};  // peak to peak, body lengths
    std::array<double, kWaveStations> phases{};      // radians, unwrapped from nose to tail
    // Body lengths, from the slope of the straight line through the phases behind ring 2.
    double wavelength = 0;

    // The least fall of the phase from one station to the next, from ring 2 to the tail, radians:
    // positive where the wave travels towards the tail everywhere.
    [[nodiscard]] double leastPhaseFall() const;
};

// The body wave of one cycle of straight swimming; the fish must move forward.
[[nodiscard]] BodyWave bodyWave(const motion::ActionSegment& segment);

}  // namespace aquarama::capture
