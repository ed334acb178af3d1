// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/segment_measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "master/capture/measure/measure.h"

namespace aquarama::report {

SpeedLine fitSpeed(const motion::Repertoire& repertoire) {
    std::array<glm::dvec2, kGaits> points;  // beat and speed, then their distances from the mean
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
