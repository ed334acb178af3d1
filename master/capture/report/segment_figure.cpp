// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "master/capture/measure/course.h"
#include "master/capture/report/fish_view.h"
#include "master/capture/report/path_figures.h"
#include "master/capture/report/plot.h"

namespace aquarama::report {

namespace {

constexpr const char* kFlesh =
    R"(fill="#b9cbd6" stroke="#33515f" stroke-width="1.1" stroke-linejoin="round")";
constexpr const char* kFinFlesh = R"(fill="#dbe5ea" stroke="#6d8794" stroke-width="0.8")";
constexpr const char* kXAxis = R"(stroke="#10202b" stroke-width="1.1")";
constexpr const char* kZAxis = R"(stroke="#e08a2c" stroke-width="1.1")";
constexpr const char* kFrame = R"(fill="none" stroke="#c9d3d9" stroke-width="1")";
constexpr double kXAxisLength = 0.22;  // body lengths
constexpr double kZAxisLength = 0.16;

constexpr std::size_t kPanels = 8;
constexpr std::size_t kColumns = 4;
constexpr std::size_t kArrowEvery = 2;  // phases
constexpr double kPanelWidth = 262;
constexpr double kMargin = 0.06;  // body lengths
constexpr double kTop = 24;       // paper units above a panel's fish, for its time
constexpr double kGap = 10;

// From body lengths to the paper.
struct Chart {
    glm::dvec2 corner{};  // of the panel, on the paper
    glm::dvec2 least{};   // in body lengths, at that corner
    double scale = 1;     // paper units a body length
    [[nodiscard]] glm::dvec2 operator()(glm::dvec2 bodyLengths) const {
        return corner + (bodyLengths - least) * scale;
    }
    [[nodiscard]] std::vector<glm::dvec2> operator()(std::vector<glm::dvec2> points) const {
        for (glm::dvec2& point : points) point = (*this)(point);
        return points;
    }
};

struct Extent {
    glm::dvec2 least{1e9};
    glm::dvec2 most{-1e9};
    void add(const std::vector<glm::dvec2>& points) {
        for (const glm::dvec2& point : points) {
            least = glm::min(least, point);
            most = glm::max(most, point);
        }
    }
};

void drawArrow(Svg& svg, glm::dvec2 from, glm::dvec2 to, const SvgStyle& style) {
    const glm::dvec2 along = glm::normalize(to - from);
    const glm::dvec2 across{-along.y, along.x};
    svg.line(from, to, style);
    svg.line(to, to - along * 4.0 + across * 2.2, style);
    svg.line(to, to - along * 4.0 - across * 2.2, style);
}

void drawFish(Svg& svg, const Chart& chart, const FishOutline& view) {
    for (const auto& fin : view.pectorals) svg.polygon(chart(fin), kFinFlesh);
    svg.polygon(chart(view.outline), kFlesh);
    svg.polyline(chart(view.midline), stroke("#6d8794", 0.8));
    svg.circle(chart(view.midline.front()), 2.2, "fill=\"#10202b\"");
}

glm::dvec2 tipOf(const capture::ReplayedPhase& phase, const glm::dvec3& axis) {
    return fromAbove(phase.origin + phase.worldFromBody * axis);
}

constexpr glm::dvec3 kX{kXAxisLength, 0, 0};
constexpr glm::dvec3 kZ{0, 0, kZAxisLength};

void drawTrail(Svg& svg,
               const Chart& chart,
               const std::vector<capture::ReplayedPhase>& phases,
               std::size_t last) {
    for (const auto& [axis, style] : {std::pair{kZ, kZAxis}, std::pair{kX, kXAxis}})
        for (std::size_t k = 0; k <= last; k += kArrowEvery)
            drawArrow(
                svg, chart(fromAbove(phases[k].origin)), chart(tipOf(phases[k], axis)), style);
}

void drawKey(Svg& svg, glm::dvec2 at, double right, double bodyLength) {
    drawArrow(svg, at, at + glm::dvec2(30, 0), kXAxis);
    svg.text(at + glm::dvec2(38, 4), "x axis of the body frame, anterior", letters(12));
    drawArrow(svg, at + glm::dvec2(260, 0), at + glm::dvec2(290, 0), kZAxis);
    svg.text(at + glm::dvec2(298, 4), "z axis, to the right", letters(12));
    const glm::dvec2 bar{right - bodyLength - 12, at.y};
    svg.line(bar, bar + glm::dvec2(bodyLength, 0), stroke(kInk, 2));
    svg.text(bar + glm::dvec2(-8, 4), "1 body length", letters(12, "end"));
}

Extent extentOf(const std::vector<FishOutline>& views,
                const std::vector<capture::ReplayedPhase>& phases) {
    Extent extent;
    for (const FishOutline& view : views) {
        extent.add(view.outline);
        extent.add(view.midline);
        for (const auto& fin : view.pectorals) extent.add(fin);
    }
    for (std::size_t k = 0; k < phases.size(); k += kArrowEvery)
        extent.add({tipOf(phases[k], kX), tipOf(phases[k], kZ)});
    extent.least -= kMargin;
    extent.most += kMargin;
    return extent;
}

}  // namespace

std::string drawSegment(const motion::ActionSegment& segment) {
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, 1);
    std::vector<FishOutline> views;
    const auto phaseOf = [](std::size_t panel) { return panel * motion::kPhases / (kPanels - 1); };
    for (std::size_t i = 0; i < kPanels; ++i)
        views.push_back(viewFromAbove(segment, phases.at(phaseOf(i)), phaseOf(i)));
    const Extent extent = extentOf(views, phases);
    const glm::dvec2 size = extent.most - extent.least;
    const double scale = kPanelWidth / size.x;
    const double panelHeight = size.y * scale + kTop;
    const double width = kColumns * (kPanelWidth + kGap) + kGap;
    const double height = 2 * (panelHeight + kGap) + kGap + 30;

    Svg svg(width, height);
    for (std::size_t i = 0; i < kPanels; ++i) {
        const std::size_t row = i / kColumns;
        const glm::dvec2 corner{kGap + static_cast<double>(i % kColumns) * (kPanelWidth + kGap),
                                kGap + static_cast<double>(row) * (panelHeight + kGap)};
        svg.rectangle(corner, {kPanelWidth, panelHeight}, kFrame);
        const Chart chart{corner + glm::dvec2(0, kTop), extent.least, scale};
        drawFish(svg, chart, views[i]);
        drawTrail(svg, chart, phases, phaseOf(i));
        const double seconds = static_cast<double>(segment.periodSeconds) *
                               static_cast<double>(phaseOf(i)) / motion::kPhases;
        svg.text(corner + glm::dvec2(8, 17), fixed(seconds, 3) + " s", letters(12));
    }
    drawKey(svg, {kGap + 4, height - 16}, width, scale);
    return std::move(svg).finish();
}

}  // namespace aquarama::report
