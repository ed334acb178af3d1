// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/midlines.h"

#include <algorithm>

#include "master/capture/measure/course.h"
#include "master/capture/report/fish_view.h"

namespace aquarama::report {

namespace {

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

}  // namespace aquarama::report
