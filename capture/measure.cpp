// SPDX-License-Identifier: Apache-2.0
#include "capture/measure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "common/base/units.h"
#include "common/motion/motor_tables.h"

namespace aquarama::capture {

// The mean frame of motion::pathOf() is the body frame averaged over a cycle.
std::vector<ReplayedPhase> replayAlongX(const motion::ActionSegment& segment, int cycles) {
    const glm::dquat meanFromBody = glm::conjugate(motion::pathOf(segment).bodyFromMean[0]);
    std::vector<ReplayedPhase> phases = replay(segment, cycles);
    for (ReplayedPhase& phase : phases) {
        phase.origin = meanFromBody * phase.origin;
        phase.worldFromBody = meanFromBody * phase.worldFromBody;
        for (glm::dvec3& node : phase.nodes) node = meanFromBody * node;
    }
    return phases;
}

namespace {

// Body wave.

constexpr std::size_t kRing2 = 2;  // indices of stations; 0 is the nose
constexpr std::size_t kRing3 = 3;

// The middle of the nodes of a station, in the frame of `nodes`.
glm::dvec3 stationOf(const NodeVectors& nodes, std::size_t station) {
    if (station == 0) return nodes[0];
    if (station + 1 == kWaveStations) return (nodes[21] + nodes[22]) / 2.0;
    glm::dvec3 sum{};
    for (std::size_t k = 0; k < 4; ++k) sum += nodes.at(1 + 4 * (station - 1) + k);
    return sum / 4.0;
}

// Radians by body length: the slope of the least-squares line through the phases from ring 3 to the
// tail.
double slopeBehindRing2(const BodyWave& wave) {
    constexpr double kStations = kWaveStations - kRing3;
    double s = 0, p = 0, ss = 0, sp = 0;
    for (std::size_t i = kRing3; i < kWaveStations; ++i) {
        s += wave.stations.at(i) / kStations;
        p += wave.phases.at(i) / kStations;
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

// A discrete Fourier transform of each station at the frequency of the beat. The phases are
// unwrapped from the nose on: neighbouring stations differ by less than half a turn.
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

namespace {

// Figures of a segment.

// The motion from phase to phase, scaled to a tick.
double largestStepOf(const motion::ActionSegment& segment) {
    const double phasesInTick =
        motion::kPhases / (static_cast<double>(segment.periodSeconds) * kTicksPerSecond);
    double largest = 0;
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        const NodeVectors now = poseAt(segment, k);
        const NodeVectors next = poseAt(segment, k + 1);
        for (std::size_t i = 0; i < now.size(); ++i)
            largest = std::max(largest, glm::distance(now.at(i), next.at(i)) * phasesInTick);
    }
    return largest;
}

// The path of a cycle without the sway of the beat. For a straight cycle it is the chord. For a
// cycle that turns it is an arc: the centre is the fixed point of the cycle's rotation, the radius
// the mean distance of the origin from it. `isSharp` marks a turn that plays to its end: it has no
// beat, so the path is summed phase by phase.
double strideOf(const std::vector<ReplayedPhase>& phases, double turn, bool isSharp) {
    const glm::dvec3 chord = phases.back().origin - phases.front().origin;
    constexpr double kStraight = 1e-4;  // radians a cycle; below it the centre is too far off
    if (!isSharp && std::abs(turn) < kStraight) return glm::length(chord);
    const glm::dvec3 toTheLeft = glm::cross(glm::dvec3(0, 1, 0), chord);
    const glm::dvec3 centre =
        phases.front().origin + (chord + toTheLeft / std::tan(turn / 2)) / 2.0;
    double way = 0;
    for (std::size_t k = 0; k + 1 < phases.size(); ++k)
        way += isSharp ? glm::distance(phases[k].origin, phases[k + 1].origin)
                       : glm::distance(phases[k].origin, centre) * std::abs(turn) / motion::kPhases;
    return way;
}

// The extent of a point's path along the unit vector `across`; pointOf takes the nodes of a phase.
double peakToPeak(const std::vector<ReplayedPhase>& phases,
                  const glm::dvec3& across,
                  const auto& pointOf) {
    double least = std::numeric_limits<double>::max();
    double most = -least;
    for (const ReplayedPhase& phase : phases) {
        const double at = glm::dot(pointOf(phase.nodes), across);
        least = std::min(least, at);
        most = std::max(most, at);
    }
    return most - least;
}

}  // namespace

NodeVectors poseAt(const motion::ActionSegment& segment, std::size_t phase) {
    NodeVectors pose{};
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const auto& integers = segment.nodes.at(phase % motion::kPhases).at(i);
        pose.at(i) = static_cast<double>(motion::kPoseUnit) *
                     glm::dvec3(integers[0], integers[1], integers[2]);
    }
    return pose;
}

// Composes the increments in the body frame, B' = B * increment; the rotation is normalised at each
// phase, so that rounding does not add up over many cycles.
std::vector<ReplayedPhase> replay(const motion::ActionSegment& segment, int cycles) {
    assert(cycles >= 1);
    std::vector<ReplayedPhase> phases;
    glm::dvec3 origin{};
    glm::dquat rotation{1, 0, 0, 0};
    const auto count = static_cast<std::size_t>(cycles) * motion::kPhases;
    for (std::size_t k = 0; k <= count; ++k) {
        ReplayedPhase phase{origin, rotation, poseAt(segment, k)};
        for (glm::dvec3& node : phase.nodes) node = origin + rotation * node;
        phases.push_back(phase);
        const motion::FrameIncrement& increment = segment.increments.at(k % motion::kPhases);
        origin += rotation * glm::dvec3(increment.translation);
        rotation = glm::normalize(rotation * glm::dquat(increment.rotation));
    }
    return phases;
}

SegmentMeasures measure(const motion::ActionSegment& segment) {
    const std::vector<ReplayedPhase> phases = replay(segment, 1);
    const ReplayedPhase& end = phases.back();
    const glm::dvec3 up{0, 1, 0};
    const glm::dvec3 heading = end.worldFromBody * glm::dvec3(1, 0, 0);
    SegmentMeasures m;
    m.periodSeconds = static_cast<double>(segment.periodSeconds);
    m.turnRadians = std::atan2(-heading.z, heading.x);
    m.turnRate = m.turnRadians / m.periodSeconds;
    m.strideBodyLengths = strideOf(phases, m.turnRadians, segment.playsToEnd);
    m.speedBodyLengths = m.strideBodyLengths / m.periodSeconds;
    m.leanRadians = std::acos(std::min(1.0, glm::dot(end.worldFromBody * up, up)));
    m.climb = end.origin.y;
    m.largestStep = largestStepOf(segment);

    // Amplitudes are taken across the chord from the start to the end of the cycle.
    const glm::dvec3 across = glm::normalize(glm::cross(end.origin, up));
    m.tailAmplitude = peakToPeak(
        phases, across, [](const NodeVectors& nodes) { return (nodes[21] + nodes[22]) / 2.0; });
    m.noseAmplitude = peakToPeak(phases, across, [](const NodeVectors& nodes) { return nodes[0]; });
    m.strouhal = m.tailAmplitude / m.strideBodyLengths;
    return m;
}

}  // namespace aquarama::capture
