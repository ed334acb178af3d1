// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "common/units/angle.h"
#include "master/capture/measure/course.h"
#include "master/capture/report/fish_view.h"
#include "master/capture/report/path_figures.h"
#include "master/capture/report/plot.h"

namespace aquarama::report {

namespace {

constexpr auto kFirstTurn = static_cast<std::size_t>(motion::Action::TurnLeftGradual);
constexpr double kWidth = 460;
constexpr double kHeight = 400;
constexpr double kHeadingLength = 0.25;  // body lengths

// Ahead and to the left, body lengths.
struct Way {
    std::vector<glm::dvec2> points;
    glm::dvec2 heading{};  // at its end
};

glm::dvec2 aheadAndLeft(const glm::dvec3& world) {
    return {world.x, -world.z};
}

Way wayOf(const motion::ActionSegment& segment) {
    Way way;
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, 1);
    for (const capture::ReplayedPhase& phase : phases)
        way.points.push_back(aheadAndLeft(phase.origin));
    way.heading = glm::normalize(aheadAndLeft(phases.back().worldFromBody * glm::dvec3(1, 0, 0)));
    return way;
}

void drawWay(Svg& svg, const Plot& plot, const Way& way, const char* colour) {
    svg.polyline(plot.at(way.points), stroke(colour, 2.4));
    const glm::dvec2 end = way.points.back();
    const glm::dvec2 tip = end + way.heading * kHeadingLength;
    const glm::dvec2 across = glm::dvec2(-way.heading.y, way.heading.x) * 0.03;
    const glm::dvec2 foot = tip - way.heading * 0.08;
    svg.polyline(plot.at({end, tip}), stroke(colour, 1.2));
    svg.polygon(plot.at({tip, foot + across, foot - across}),
                std::string("fill=\"") + colour + "\"");
}

// Seconds and degrees, to the left.
std::vector<glm::dvec2> headingOver(const motion::ActionSegment& segment) {
    std::vector<glm::dvec2> points;
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, 1);
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const glm::dvec2 heading = aheadAndLeft(phases[k].worldFromBody * glm::dvec3(1, 0, 0));
        points.emplace_back(
            static_cast<double>(segment.periodSeconds) * static_cast<double>(k) / motion::kPhases,
            std::atan2(heading.y, heading.x) / kRadiansPerDegree<double>);
    }
    return points;
}

std::vector<std::pair<SvgStyle, std::string>> legendOfTurns() {
    std::vector<std::pair<SvgStyle, std::string>> legend;
    for (std::size_t i = kFirstTurn; i < motion::kCapturedActions; ++i)
        legend.emplace_back(stroke(colourOf(i), 2.4),
                            motion::nameOf(static_cast<motion::Action>(i)));
    return legend;
}

}  // namespace

std::string drawTurns(const motion::Repertoire& repertoire) {
    std::vector<Way> ways;
    double ahead = 0;
    double aside = 0;
    for (std::size_t i = kFirstTurn; i < motion::kCapturedActions; ++i) {
        ways.push_back(wayOf(repertoire.segments.at(i)));
        const Way& way = ways.back();
        for (const glm::dvec2 point : way.points) {
            ahead = std::max(ahead, point.x);
            aside = std::max(aside, std::abs(point.y));
        }
        const glm::dvec2 tip = way.points.back() + way.heading * kHeadingLength;
        ahead = std::max(ahead, tip.x);
        aside = std::max(aside, std::abs(tip.y));
    }
    const double tick = ahead > 2 ? 0.5 : 0.25;
    const double most = std::ceil((ahead + 0.05) / tick) * tick;
    const double side = std::ceil((aside + 0.05) / tick) * tick;
    const double scale = std::min(kWidth / most, kHeight / (2 * side));
    const glm::dvec2 size = glm::dvec2(most, 2 * side) * scale;
    Svg svg(size.x + 80, size.y + 60);
    const Plot plot(
        {58, 14}, size, {0, most, tick, 2, "ahead, BL"}, {-side, side, tick, 2, "to the left, BL"});
    plot.drawAxes(svg);
    for (std::size_t i = 0; i < ways.size(); ++i)
        drawWay(svg, plot, ways[i], colourOf(kFirstTurn + i));
    drawLegend(svg, {70, 32}, legendOfTurns());
    return std::move(svg).finish();
}

std::string drawHeadings(const motion::Repertoire& repertoire) {
    std::vector<std::vector<glm::dvec2>> headings;
    double longest = 0;
    double most = 0;
    for (std::size_t i = kFirstTurn; i < motion::kCapturedActions; ++i) {
        headings.push_back(headingOver(repertoire.segments.at(i)));
        longest = std::max(longest, headings.back().back().x);
        for (const glm::dvec2 point : headings.back()) most = std::max(most, std::abs(point.y));
    }
    const double seconds = longest > 2 ? 0.5 : longest > 1 ? 0.25 : 0.1;
    const double degrees = std::ceil((most + 2) / 20) * 20;
    const double xMost = std::ceil(longest / seconds) * seconds;
    Svg svg(520, kHeight + 60);
    const Plot plot({58, 14},
                    {440, kHeight},
                    {0, xMost, seconds, 2, "time, s"},
                    {-degrees, degrees, 20, 0, "heading, deg, to the left"});
    plot.drawAxes(svg);
    for (std::size_t i = 0; i < headings.size(); ++i)
        svg.polyline(plot.at(headings[i]), stroke(colourOf(kFirstTurn + i), 2.4));
    // Between the turns to both sides, where they are over.
    drawLegend(svg, plot.at(xMost, 0) - glm::dvec2(170, 27), legendOfTurns());
    return std::move(svg).finish();
}

}  // namespace aquarama::report
