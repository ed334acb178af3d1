// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture/measure.h"

namespace aquarama::capture {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr std::array<double, kWaveStations> kStations{0, 0.2, 0.4, 0.55, 0.7, 0.85, 1};

std::size_t stationOfNode(std::size_t node) {
    return node == 0 ? 0 : 1 + (node - 1) / 4;
}

double halfSwingAt(double s) {
    return 0.02 + 0.08 * s * s;
}

// Swims 0.6 lengths a beat along +x, while a wave of the given length runs towards the tail.
motion::ActionSegment swimming(double wavelength) {
    motion::ActionSegment segment;
    segment.periodSeconds = 0.5F;
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        segment.increments.at(k).translation = {0.6F / motion::kPhases, 0, 0};
        for (std::size_t node = 0; node < std::size_t{body::kNodalPoints}; ++node) {
            const double s = kStations.at(stationOfNode(node));
            const double phase =
                kTwoPi * (static_cast<double>(k) / motion::kPhases - s / wavelength);
            const double z = halfSwingAt(s) * std::sin(phase);
            segment.nodes.at(k).at(node) = {
                static_cast<std::int16_t>(std::lround((0.4 - s) * 32767)),
                0,
                static_cast<std::int16_t>(std::lround(z * 32767))};
        }
    }
    return segment;
}

TEST(BodyWave, isTheWaveThatTheNodesSwing) {
    for (const double wavelength : {0.6, 1.0, 1.7}) {
        const BodyWave wave = bodyWave(swimming(wavelength));
        EXPECT_NEAR(wave.wavelength, wavelength, 1e-3);
        for (std::size_t i = 0; i < kWaveStations; ++i) {
            EXPECT_NEAR(wave.stations.at(i), kStations.at(i), 1e-4);
            EXPECT_NEAR(wave.amplitudes.at(i), 2 * halfSwingAt(kStations.at(i)), 1e-4);
            EXPECT_NEAR(wave.phases.at(i) - wave.phases.at(0),
                        -kTwoPi * kStations.at(i) / wavelength,
                        2e-3);
        }
        EXPECT_NEAR(wave.leastPhaseFall(), kTwoPi * 0.15 / wavelength, 4e-3);
    }
}

TEST(BodyWave, thatRunsForwardsDoesNotFall) {
    EXPECT_LT(bodyWave(swimming(-1)).leastPhaseFall(), 0);
}

}  // namespace
}  // namespace aquarama::capture
