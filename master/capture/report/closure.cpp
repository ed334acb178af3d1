// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/closure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "master/capture/measure/course.h"

namespace aquarama {

namespace {

glm::dvec3 nodeAt(const ActionSegment& segment, std::size_t phase, std::size_t node) {
    const auto& integers = segment.nodes.at(phase % kPhases).at(node);
    return static_cast<double>(kPoseUnit) * glm::dvec3(integers[0], integers[1], integers[2]);
}

double roughnessAt(const ActionSegment& segment, std::size_t k) {
    double most = 0;
    for (std::size_t i = 0; i < kNodalPoints; ++i) {
        const auto at = [&](std::size_t ahead) { return nodeAt(segment, k + ahead, i); };
        const glm::dvec3 smooth = (4.0 * (at(kPhases - 1) + at(1)) - at(kPhases - 2) - at(2)) / 6.0;
        most = std::max(most, glm::distance(at(0), smooth));
    }
    return most;
}

double headingOf(const ReplayedPhase& phase) {
    const glm::dvec3 ahead = phase.worldFromBody * glm::dvec3(1, 0, 0);
    return std::atan2(-ahead.z, ahead.x);
}

}  // namespace

Seam seamOf(const ActionSegment& segment) {
    Seam seam;
    for (std::size_t k = 0; k < kPhases; ++k) {
        const bool isAtTheJoin = k < 2 || k + 2 >= kPhases;
        double& most = isAtTheJoin ? seam.atTheJoin : seam.elsewhere;
        most = std::max(most, roughnessAt(segment, k));
    }
    return seam;
}

Drift driftAfter(const ActionSegment& segment, int repetitions) {
    const std::vector<ReplayedPhase> phases = replayAlongX(segment, repetitions);
    const ReplayedPhase& start = phases.front();
    const ReplayedPhase& end = phases.back();
    const double once = headingOf(phases[kPhases]) - headingOf(start);
    const double told = segment.playsToEnd ? once * repetitions : 0;
    const glm::dvec3 up{0, 1, 0};
    const double uprightness = glm::dot(end.worldFromBody * up, start.worldFromBody * up);
    return {.headingRadians =
                std::remainder(headingOf(end) - headingOf(start) - told, 2 * std::numbers::pi),
            .leanRadians = std::acos(std::min(1.0, uprightness)),
            .climb = end.origin.y};
}

}  // namespace aquarama
