// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/closure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "master/capture/measure/course.h"

namespace aquarama::report {

namespace {

double roughnessAt(const motion::ActionSegment& segment, std::size_t k) {
    const auto ahead = [&](std::size_t phases) { return capture::poseAt(segment, k + phases); };
    const std::array poses{
        ahead(motion::kPhases - 2), ahead(motion::kPhases - 1), ahead(0), ahead(1), ahead(2)};
    double most = 0;
    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
        const glm::dvec3 smooth =
            (4.0 * (poses[1].at(i) + poses[3].at(i)) - poses[0].at(i) - poses[4].at(i)) / 6.0;
        most = std::max(most, glm::distance(poses[2].at(i), smooth));
    }
    return most;
}

double headingOf(const capture::ReplayedPhase& phase) {
    const glm::dvec3 ahead = phase.worldFromBody * glm::dvec3(1, 0, 0);
    return std::atan2(-ahead.z, ahead.x);
}

}  // namespace

Seam seamOf(const motion::ActionSegment& segment) {
    Seam seam;
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        const bool isAtTheJoin = k < 2 || k + 2 >= motion::kPhases;
        double& most = isAtTheJoin ? seam.atTheJoin : seam.elsewhere;
        most = std::max(most, roughnessAt(segment, k));
    }
    return seam;
}

Drift driftAfter(const motion::ActionSegment& segment, int repetitions) {
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, repetitions);
    const capture::ReplayedPhase& start = phases.front();
    const capture::ReplayedPhase& end = phases.back();
    const double once = headingOf(phases[motion::kPhases]) - headingOf(start);
    const double told = segment.playsToEnd ? once * repetitions : 0;
    const glm::dvec3 up{0, 1, 0};
    const double uprightness = glm::dot(end.worldFromBody * up, start.worldFromBody * up);
    return {.headingRadians =
                std::remainder(headingOf(end) - headingOf(start) - told, 2 * std::numbers::pi),
            .leanRadians = std::acos(std::min(1.0, uprightness)),
            .climb = end.origin.y};
}

}  // namespace aquarama::report
