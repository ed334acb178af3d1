// SPDX-License-Identifier: Apache-2.0
#include "capture/report/segment_figures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "capture/measure.h"
#include "capture/report/silhouette.h"

namespace aquarama::report {

namespace {

// Closure.

// The greatest distance, at phase k, of a nodal point from the cubic through its four neighbours in
// time. The weights -1/6, 4/6, 4/6, -1/6 are Lagrange's for evenly spaced places.
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

// Left of +x positive, radians.
double headingOf(const capture::ReplayedPhase& phase) {
    const glm::dvec3 ahead = phase.worldFromBody * glm::dvec3(1, 0, 0);
    return std::atan2(-ahead.z, ahead.x);
}

}  // namespace

Seam seamOf(const motion::ActionSegment& segment) {
    Seam seam;
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        // At two phases on either side of the end the neighbours are from both ends of the cycle.
        const bool isAtTheJoin = k < 2 || k + 2 >= motion::kPhases;
        double& most = isAtTheJoin ? seam.atTheJoin : seam.elsewhere;
        most = std::max(most, roughnessAt(segment, k));
    }
    return seam;
}

Drift driftAfter(const motion::ActionSegment& segment, bool turns, int repetitions) {
    assert(repetitions >= 1);
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, repetitions);
    const capture::ReplayedPhase& start = phases.front();
    const capture::ReplayedPhase& end = phases.back();
    const double once = headingOf(phases[motion::kPhases]) - headingOf(start);
    const double told = turns ? once * repetitions : 0;
    const glm::dvec3 up{0, 1, 0};
    const double uprightness = glm::dot(end.worldFromBody * up, start.worldFromBody * up);
    return {.headingRadians =
                std::remainder(headingOf(end) - headingOf(start) - told, 2 * std::numbers::pi),
            .leanRadians = std::acos(std::min(1.0, uprightness)),
            .climb = end.origin.y};
}

namespace {

// Midlines.

// `travelled` is how far the frame that moves with the mean speed has come. On the paper y is to
// the right of the fish.
Midline midlineAt(const capture::ReplayedPhase& phase, double travelled) {
    Midline line;
    for (const glm::dvec2& point : midlineFromAbove(phase)) {
        line.station.push_back(travelled - point.x);
        line.left.push_back(-point.y);
    }
    return line;
}

}  // namespace

std::vector<Midline> midlinesOf(const motion::ActionSegment& gait) {
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(gait, 1);
    // The mean over the beat of the nose's station, and of the lateral place of all points, is
    // subtracted, so that the stations begin at 0 and the lines lie symmetrically.
    const double advance = phases.back().origin.x;
    std::vector<Midline> lines;
    double nose = 0;
    double middle = 0;
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        lines.push_back(midlineAt(phases[k], advance * static_cast<double>(k) / motion::kPhases));
        nose += lines.back().station.front() / motion::kPhases;
        for (const double left : lines.back().left)
            middle += left / (motion::kPhases * kMidlinePoints);
    }
    for (Midline& line : lines) {
        for (double& station : line.station) station -= nose;
        for (double& left : line.left) left -= middle;
    }
    return lines;
}

Swing swingOf(const std::vector<Midline>& lines) {
    Swing swing;
    assert(!lines.empty());
    for (std::size_t j = 0; j < kMidlinePoints; ++j) {
        double least = 1;
        double most = -1;
        double station = 0;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            const double left = lines[k].left[j];
            least = std::min(least, left);
            most = std::max(most, left);
            station += lines[k].station[j] / static_cast<double>(lines.size());
        }
        swing.station.push_back(station);
        swing.half.push_back((most - least) / 2);
    }
    return swing;
}

SpeedLine fitSpeed(const motion::Repertoire& repertoire) {
    // Beat frequency and speed; in the second loop their distances from the mean.
    std::array<glm::dvec2, kGaits> points;
    glm::dvec2 mean{};
    for (std::size_t i = 0; i < kGaits; ++i) {
        const capture::SegmentMeasures m = capture::measure(repertoire.segments.at(i));
        points.at(i) = {1 / m.periodSeconds, m.speedBodyLengths};
        mean += points.at(i) / static_cast<double>(kGaits);
    }
    glm::dvec2 squares{};
    double product = 0;
    for (glm::dvec2& point : points) {
        point -= mean;
        squares += point * point;
        product += point.x * point.y;
    }
    const double slope = product / squares.x;
    return {slope, mean.y - slope * mean.x, slope * product / squares.y};
}

double turnRadius(const motion::ActionSegment& segment) {
    const capture::SegmentMeasures m = capture::measure(segment);
    return m.strideBodyLengths / std::abs(m.turnRadians);
}

double peakTurnRate(const motion::ActionSegment& segment) {
    double peak = 0;
    for (const motion::FrameIncrement& increment : segment.increments)
        peak = std::max(peak, std::abs(static_cast<double>(glm::angle(increment.rotation))));
    return peak * motion::kPhases / static_cast<double>(segment.periodSeconds);
}

}  // namespace aquarama::report
