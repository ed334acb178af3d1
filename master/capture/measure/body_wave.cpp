// SPDX-License-Identifier: Apache-2.0
#include "master/capture/measure/body_wave.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "master/capture/measure/measure.h"

namespace aquarama::capture {

namespace {

constexpr std::size_t kRing2 = 2;  // among the stations
constexpr std::size_t kRing3 = 3;

glm::dvec3 stationOf(const NodeVectors& nodes, std::size_t station) {
    if (station == 0) return nodes[0];
    if (station + 1 == kWaveStations) return (nodes[21] + nodes[22]) / 2.0;
    glm::dvec3 sum{};
    for (std::size_t k = 0; k < 4; ++k) sum += nodes.at(1 + 4 * (station - 1) + k);
    return sum / 4.0;
}

// Of the least-squares line through the phases from ring 3 on.
double slopeBehindRing2(const BodyWave& wave) {
    constexpr double kCount = kWaveStations - kRing3;
    double s = 0, p = 0, ss = 0, sp = 0;
    for (std::size_t i = kRing3; i < kWaveStations; ++i) {
        s += wave.stations.at(i) / kCount;
        p += wave.phases.at(i) / kCount;
    }
    for (std::size_t i = kRing3; i < kWaveStations; ++i) {
        ss += (wave.stations.at(i) - s) * (wave.stations.at(i) - s);
        sp += (wave.stations.at(i) - s) * (wave.phases.at(i) - p);
    }
    return sp / ss;
}

}  // namespace

double BodyWave::leastPhaseFall() const {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = kRing2; i + 1 < kWaveStations; ++i)
        least = std::min(least, phases.at(i) - phases.at(i + 1));
    return least;
}

BodyWave bodyWave(const motion::ActionSegment& segment) {
    constexpr double kTurn = 2 * std::numbers::pi;
    const std::vector<ReplayedPhase> cycle = replay(segment, 1);
    const glm::dvec3 course = glm::normalize(cycle.back().origin);
    const glm::dvec3 across = glm::cross(course, glm::dvec3(0, 1, 0));
    BodyWave wave;
    for (std::size_t i = 0; i < kWaveStations; ++i) {
        std::complex<double> harmonic;
        for (std::size_t k = 0; k < motion::kPhases; ++k) {
            const glm::dvec3 at = stationOf(cycle[k].nodes, i);
            harmonic += glm::dot(at, across) *
                        std::polar(2.0 / motion::kPhases,
                                   -kTurn * static_cast<double>(k) / motion::kPhases);
            wave.stations.at(i) += glm::dot(cycle[k].nodes[0] - at, course) / motion::kPhases;
        }
        wave.amplitudes.at(i) = 2 * std::abs(harmonic);
        wave.phases.at(i) = std::arg(harmonic);
        if (i > 0)
            wave.phases.at(i) = wave.phases.at(i - 1) +
                                std::remainder(wave.phases.at(i) - wave.phases.at(i - 1), kTurn);
    }
    wave.wavelength = kTurn / std::abs(slopeBehindRing2(wave));
    return wave;
}

}  // namespace aquarama::capture
