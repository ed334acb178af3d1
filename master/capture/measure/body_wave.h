// SPDX-License-Identifier: Apache-2.0
// The wave that runs down a swimming fish: how far and when each part of its body swings.
#pragma once

#include <array>
#include <cstddef>

#include "common/motion/repertoire.h"

namespace aquarama::capture {

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
