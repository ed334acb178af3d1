// SPDX-License-Identifier: Apache-2.0
// A repertoire in closed form, for tests that need fish which swim but no capture: a carangiform
// wave on a straight course or an arc, recorded by eq. 1 to 9 as a captured one is.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "common/base/units.h"
#include "common/motion/repertoire.h"

namespace aquarama::synthetic {

inline constexpr double kOriginStation = 0.385;  // ring 2, the body frame's origin (eq. 1)
inline constexpr double kStrideBodyLengths = 0.67;

// The path is straight, or an arc in the horizontal or in the vertical plane.
struct Gait {
    double periodSeconds = 1.0;
    double turnRadians = 0.0;  // of one cycle, left positive
    double stride = kStrideBodyLengths;
    bool bends = false;         // a C-bend: the turn begins and ends straight
    double pitchRadians = 0.0;  // of one cycle, up positive
};

inline std::array<Gait, motion::kCapturedActions> gaits() {
    using motion::Action;
    std::array<Gait, motion::kCapturedActions> all;
    const auto of = [&](Action action) -> Gait& { return all.at(indexOf(action)); };
    for (std::size_t gait = 0; gait < motion::kForwardGaits; ++gait) {
        const auto each = static_cast<Action>(gait);
        const double period = 1.0 / static_cast<double>(gait + 1);  // fast: 2 body lengths a second
        for (std::size_t a = gait; a < motion::kSwimmingActions; a += motion::kForwardGaits)
            all.at(a).periodSeconds = period;
        of(atGait(Action::CurveLeftWideSlow, each)).turnRadians = 8 * kDegree;
        of(atGait(Action::CurveLeftTightSlow, each)).turnRadians = 16 * kDegree;
        of(atGait(Action::CurveRightWideSlow, each)).turnRadians = -8 * kDegree;
        of(atGait(Action::CurveRightTightSlow, each)).turnRadians = -16 * kDegree;
        of(atGait(Action::ClimbSlow, each)).pitchRadians = 8 * kDegree;
        of(atGait(Action::DiveSlow, each)).pitchRadians = -8 * kDegree;
    }
    of(Action::Retreat) = {.periodSeconds = 1.0, .stride = -0.3};
    const auto turn = [](double seconds, double degrees, double stride) {
        return Gait{.periodSeconds = seconds,
                    .turnRadians = degrees * kDegree,
                    .stride = stride,
                    .bends = true};
    };
    of(Action::TurnLeftGradual) = turn(0.6, 30, 0.8);
    of(Action::TurnLeftSharp) = turn(1.0, 60, 1.0);
    of(Action::TurnRightGradual) = turn(0.6, -30, 0.8);
    of(Action::TurnRightSharp) = turn(1.0, -60, 1.0);
    return all;
}

inline double headingAt(const Gait& gait, double phase) {
    return gait.turnRadians * (gait.bends ? phase * phase * (3 - 2 * phase) : phase);
}

// Turned from the course at phase 0 to that at a phase.
inline glm::dmat3 turnedAt(const Gait& gait, double phase) {
    const double c = std::cos(headingAt(gait, phase));
    const double s = std::sin(headingAt(gait, phase));
    const double up = gait.pitchRadians * phase;
    const glm::dmat3 yaw({c, 0, -s}, {0, 1, 0}, {s, 0, c});
    const glm::dmat3 pitch(
        {std::cos(up), std::sin(up), 0}, {-std::sin(up), std::cos(up), 0}, {0, 0, 1});
    return yaw * pitch;
}

// The course of the cycle-mean frame, by Simpson's rule over its heading.
inline glm::dvec3 courseAt(const Gait& gait, double phase) {
    constexpr int kIntervals = 64;
    glm::dvec3 sum{};
    for (int i = 0; i <= kIntervals; ++i) {
        const double weight = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * turnedAt(gait, phase * i / kIntervals)[0];
    }
    return sum * (gait.stride * phase / (3.0 * kIntervals));
}

// Sideways place of the midline at station s (0 nose, 1 tail): Videler and Hess's carangiform
// envelope; or, without a beat, a bend towards the inside of a turn. A fish that backs is straight.
inline double midline(const Gait& gait, double s, double phase) {
    const bool beats = !gait.bends && gait.stride > 0;
    const double envelope = beats ? 0.02 - 0.0825 * s + 0.1625 * s * s : 0;
    const double swing = std::sin(std::numbers::pi * phase);
    const double bend = gait.bends ? 0.67 * std::abs(gait.turnRadians) * swing * swing : 0;
    const double side = gait.turnRadians > 0 ? -1 : gait.turnRadians < 0 ? 1 : 0;  // z is right
    return envelope * std::sin(2 * std::numbers::pi * (s - phase)) +
           side * bend * (s - kOriginStation) * (s - kOriginStation);
}

// A point of the body, given at rest by station, height and distance to the right, in the world.
inline glm::dvec3 placed(const Gait& gait, double phase, const glm::dvec3& rest) {
    constexpr double kStep = 1e-5;
    const double s = rest.x;
    const double slope =
        (midline(gait, s - kStep, phase) - midline(gait, s + kStep, phase)) / (2 * kStep);
    const double across = rest.z / std::sqrt(1 + slope * slope);
    const glm::dvec3 inCourse(
        kOriginStation - s - slope * across, rest.y, midline(gait, s, phase) + across);
    return courseAt(gait, phase) + turnedAt(gait, phase) * inCourse;
}

inline std::array<glm::dvec3, body::kNodalPoints> restNodes() {
    constexpr std::array<double, 5> kStation{0.19, 0.385, 0.58, 0.77, 0.85};
    constexpr std::array<double, 5> kHalfHeight{0.051, 0.079, 0.062, 0.049, 0.042};
    constexpr std::array<double, 5> kHalfWidth{0.033, 0.043, 0.033, 0.022, 0.012};
    std::array<glm::dvec3, body::kNodalPoints> nodes{};
    for (std::size_t ring = 0; ring < kStation.size(); ++ring) {
        const double h = kHalfHeight[ring];
        const double w = kHalfWidth[ring];
        nodes[4 * ring + 1] = {kStation[ring], h, -w};
        nodes[4 * ring + 2] = {kStation[ring], h, w};
        nodes[4 * ring + 3] = {kStation[ring], -h, w};
        nodes[4 * ring + 4] = {kStation[ring], -h, -w};
    }
    nodes[21] = {1, 0.095, 0};
    nodes[22] = {1, -0.095, 0};
    return nodes;
}

// A tube of 35 rings of 12 points, and 6 points of the tail's edge.
inline std::array<glm::dvec3, body::kControlPoints> restControlPoints() {
    constexpr std::size_t kRings = 35;
    constexpr std::size_t kAround = 12;
    std::array<glm::dvec3, body::kControlPoints> points{};
    for (std::size_t ring = 0; ring < kRings; ++ring) {
        const double s = 0.9 * (static_cast<double>(ring) + 0.5) / kRings;
        const double girth = std::sqrt(s * (1 - s));
        for (std::size_t i = 0; i < kAround; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kAround;
            points[ring * kAround + i] = {
                s, 0.17 * girth * std::cos(angle), 0.09 * girth * std::sin(angle)};
        }
    }
    for (std::size_t i = 0; i < 6; ++i) {
        points[kRings * kAround + i] = {1, 0.095 * (static_cast<double>(i) / 2.5 - 1), 0};
    }
    return points;
}

struct Frame {
    glm::dvec3 origin{};
    glm::dmat3 axes{1};
};

// Eq. 1 to 4, with y of unit length.
inline Frame frameOf(const Gait& gait, double phase) {
    const auto rest = restNodes();
    const glm::dvec3 n5 = placed(gait, phase, rest[5]);
    const glm::dvec3 origin = 0.5 * (n5 + placed(gait, phase, rest[7]));
    const glm::dvec3 x = glm::normalize(placed(gait, phase, rest[0]) - origin);
    const glm::dvec3 y = glm::normalize(glm::cross(x, n5 - placed(gait, phase, rest[6])));
    return {origin, glm::dmat3(x, y, glm::cross(x, y))};
}

// Eq. 8 and 9.
template <std::size_t kPoints>
std::array<std::array<std::int16_t, 3>, kPoints> poseOf(
    const Gait& gait, double phase, const std::array<glm::dvec3, kPoints>& rest) {
    const Frame frame = frameOf(gait, phase);
    std::array<std::array<std::int16_t, 3>, kPoints> pose{};
    for (std::size_t i = 0; i < kPoints; ++i) {
        const glm::dvec3 d =
            glm::transpose(frame.axes) * (placed(gait, phase, rest[i]) - frame.origin);
        for (int axis = 0; axis < 3; ++axis) {
            pose[i][static_cast<std::size_t>(axis)] =
                static_cast<std::int16_t>(std::lround(std::clamp(d[axis], -1.0, 1.0) * 32767));
        }
    }
    return pose;
}

inline motion::ActionSegment segmentOf(const Gait& gait, bool withControlPoints) {
    motion::ActionSegment segment;
    segment.periodSeconds = static_cast<float>(gait.periodSeconds);
    segment.playsToEnd = gait.bends;
    const auto points = restControlPoints();
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        const double phase = static_cast<double>(k) / motion::kPhases;
        const Frame now = frameOf(gait, phase);
        const Frame next = frameOf(gait, static_cast<double>(k + 1) / motion::kPhases);
        const glm::dmat3 bodyFromWorld = glm::transpose(now.axes);
        segment.increments[k] = {glm::quat(glm::quat_cast(bodyFromWorld * next.axes)),
                                 glm::vec3(bodyFromWorld * (next.origin - now.origin))};
        segment.nodes[k] = poseOf(gait, phase, restNodes());
        if (withControlPoints) segment.controlPoints.push_back(poseOf(gait, phase, points));
    }
    return segment;
}

}  // namespace aquarama::synthetic

namespace aquarama::test {

inline motion::Repertoire syntheticRepertoire(bool withControlPoints = true,
                                              const std::string& species = "synthetic") {
    motion::Repertoire repertoire;
    repertoire.species = species;
    repertoire.recordedLengthMetres = 0.2F;
    const auto gaits = synthetic::gaits();
    for (std::size_t action = 0; action < motion::kCapturedActions; ++action) {
        repertoire.segments[action] = synthetic::segmentOf(gaits[action], withControlPoints);
    }
    repertoire.response = {
        .swimDrag = {0.3F, 0.4F, 0.5F}, .retreatDrag = 4.0F, .glideDrag = 0.5F, .brakeRate = 5.0F};
    motion::addGlide(repertoire);
    return repertoire;
}

}  // namespace aquarama::test
