// SPDX-License-Identifier: Apache-2.0
// What a segment does when it is replayed, in the numbers by which fish are compared.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "common/motion/repertoire.h"
#include "master/capture/biomechanical_fish.h"

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

// A segment replayed in a world that a reader can use.

// As replay(), turned about its origin so that the fish heads along +x and is level: what beats on,
// in the mean over a cycle, since the tail sways the body frame; a turn that plays to its end, at
// its start. y is up, z to the right.
[[nodiscard]] std::vector<ReplayedPhase> replayAlongX(const motion::ActionSegment& segment,
                                                      int cycles);

// The wave that runs down a swimming fish: how far and when each part of its body swings.

// The nose, the five rings, the tips of the tail.
inline constexpr std::size_t kWaveStations = 7;

// First harmonic of the swing across the course. Stations in body lengths from the nose.
struct BodyWave {
    std::array<double, kWaveStations> stations{};
    std::array<double, kWaveStations> amplitudes{};  // peak to peak, body lengths
    std::array<double, kWaveStations> phases{};      // radians, unwrapped from nose to tail
    double wavelength = 0;  // body lengths, of the straight line through the phases behind ring 2

    // The least fall of the phase from one station to the next, from ring 2 to the tail: positive
    // in a wave that travels tailwards all the way.
    [[nodiscard]] double leastPhaseFall() const;
};

// Of a cycle of straight swimming.
[[nodiscard]] BodyWave bodyWave(const motion::ActionSegment& segment);

}  // namespace aquarama::capture
