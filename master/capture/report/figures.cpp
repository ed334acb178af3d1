// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "master/capture/measure/measure.h"
#include "master/capture/report/fish_view.h"
#include "master/capture/report/svg.h"

namespace aquarama {

namespace {

constexpr const char* kInk = "#1d2b36";
constexpr const char* kFlesh =
    R"(fill="#b9cbd6" stroke="#33515f" stroke-width="1.1" stroke-linejoin="round")";
constexpr const char* kFinFlesh = R"(fill="#dbe5ea" stroke="#6d8794" stroke-width="0.8")";
constexpr const char* kSpine = R"(fill="none" stroke="#6d8794" stroke-width="0.8")";
constexpr const char* kXAxis = R"(stroke="#10202b" stroke-width="1.1")";
constexpr const char* kZAxis = R"(stroke="#e08a2c" stroke-width="1.1")";
constexpr const char* kFrame = R"(fill="none" stroke="#c9d3d9" stroke-width="1")";
constexpr double kXAxisLength = 0.22;  // body lengths
constexpr double kZAxisLength = 0.16;

SvgStyle letters(int size, const char* anchor = "start") {
    return "font-size=\"" + std::to_string(size) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
           kInk + "\"";
}

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

void drawArrow(Svg& svg, glm::dvec2 from, glm::dvec2 to, const SvgStyle& style) {
    const glm::dvec2 along = glm::normalize(to - from);
    const glm::dvec2 across{-along.y, along.x};
    svg.line(from, to, style);
    svg.line(to, to - along * 4.0 + across * 2.2, style);
    svg.line(to, to - along * 4.0 - across * 2.2, style);
}

void drawFish(Svg& svg, const Chart& chart, const FishView& view) {
    for (const auto& fin : view.pectorals) svg.polygon(chart(fin), kFinFlesh);
    svg.polygon(chart(view.outline), kFlesh);
    svg.polyline(chart(view.midline), kSpine);
    for (const glm::dvec2& eye : view.eyes) svg.circle(chart(eye), 1.8, "fill=\"#10202b\"");
}

void drawTrail(Svg& svg,
               const Chart& chart,
               const std::vector<ReplayedPhase>& phases,
               std::size_t last,
               std::size_t every) {
    const auto arrows = [&](const glm::dvec3& axis, double length, const char* style) {
        for (std::size_t k = 0; k <= last; k += every) {
            const glm::dvec3 tip = phases[k].origin + phases[k].worldFromBody * axis * length;
            drawArrow(svg, chart(fromAbove(phases[k].origin)), chart(fromAbove(tip)), style);
        }
    };
    arrows({0, 0, 1}, kZAxisLength, kZAxis);
    arrows({1, 0, 0}, kXAxisLength, kXAxis);
}

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

void drawScaleBar(Svg& svg, glm::dvec2 at, double bodyLength) {
    svg.line(at, at + glm::dvec2(bodyLength, 0), R"(stroke="#1d2b36" stroke-width="2")");
    svg.text(at + glm::dvec2(bodyLength + 8, 4), "1 body length (BL)", letters(12));
}

void drawKey(Svg& svg, glm::dvec2 at) {
    drawArrow(svg, at, at + glm::dvec2(30, 0), kXAxis);
    svg.text(at + glm::dvec2(38, 4), "x axis of the body frame, anterior", letters(12));
    drawArrow(svg, at + glm::dvec2(260, 0), at + glm::dvec2(290, 0), kZAxis);
    svg.text(at + glm::dvec2(298, 4), "z axis, right", letters(12));
}

}  // namespace

std::string drawSegment(const FishBody& body, const ActionSegment& segment, int cycles) {
    constexpr std::size_t kPanels = 8;
    constexpr std::size_t kColumns = 4;
    constexpr double kPanelWidth = 262;
    constexpr double kMargin = 0.06;  // body lengths
    constexpr double kTop = 24;       // paper units above a panel's fish, for its time
    constexpr double kGap = 10;

    const std::vector<ReplayedPhase> phases = replay(segment, cycles);
    const std::size_t total = phases.size() - 1;
    std::vector<FishView> views;
    Extent extent;
    for (std::size_t i = 0; i < kPanels; ++i) {
        views.push_back(viewFromAbove(body, phases.at(i * total / (kPanels - 1))));
        extent.add(views.back().outline);
        extent.add(views.back().midline);
        for (const auto& fin : views.back().pectorals) extent.add(fin);
    }
    extent.least -= kMargin;
    extent.most += kMargin;
    const glm::dvec2 size = extent.most - extent.least;
    const double scale = kPanelWidth / size.x;
    const double panelHeight = size.y * scale + kTop;
    const double width = kColumns * (kPanelWidth + kGap) + kGap;
    const double height = 2 * (panelHeight + kGap) + kGap + 30;

    Svg svg(width, height);
    for (std::size_t i = 0; i < kPanels; ++i) {
        const std::size_t row = i / kColumns;
        const std::size_t column = i % kColumns;
        const glm::dvec2 corner{kGap + static_cast<double>(column) * (kPanelWidth + kGap),
                                kGap + static_cast<double>(row) * (panelHeight + kGap)};
        svg.rectangle(corner, {kPanelWidth, panelHeight}, kFrame);
        const Chart chart{corner + glm::dvec2(0, kTop), extent.least, scale};
        const std::size_t now = i * total / (kPanels - 1);
        drawFish(svg, chart, views[i]);
        drawTrail(svg, chart, phases, now, total / 32);
        const double seconds =
            static_cast<double>(segment.periodSeconds) * static_cast<double>(now) / kPhases;
        svg.text(corner + glm::dvec2(8, 17), fixed(seconds, 2) + " s", letters(12));
    }
    drawKey(svg, {kGap + 4, height - 16});
    drawScaleBar(svg, {width - scale - 150, height - 16}, scale);
    return std::move(svg).finish();
}

namespace {

struct Midline {
    std::vector<double> station;  // behind the mean nose, body lengths
    std::vector<double> across;
};

// In a frame that swims along the course at the mean speed.
std::vector<Midline> midlinesOf(const FishBody& body, const ActionSegment& segment, int count) {
    const std::vector<ReplayedPhase> phases = replay(segment, 1);
    const glm::dvec2 advance = fromAbove(phases.back().origin);
    const glm::dvec2 along = glm::normalize(advance);
    const glm::dvec2 across{along.y, -along.x};  // to the left
    std::vector<Midline> lines;
    double nose = 0;
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i * kPhases / count);
        const glm::dvec2 travelled = advance * (static_cast<double>(k) / kPhases);
        Midline line;
        for (const glm::dvec2& point : viewFromAbove(body, phases.at(k)).midline) {
            line.station.push_back(-glm::dot(point - travelled, along));
            line.across.push_back(glm::dot(point - travelled, across));
        }
        nose += line.station.front() / count;
        lines.push_back(std::move(line));
    }
    double middle = 0;
    for (const Midline& line : lines)
        for (const double value : line.across)
            middle += value / static_cast<double>(line.across.size() * lines.size());
    for (Midline& line : lines) {
        for (double& value : line.station) value -= nose;
        for (double& value : line.across) value -= middle;
    }
    return lines;
}

// Half the swing of a swimming saithe's midline (Videler & Hess 1984).
double saitheHalfSwing(double s) {
    return 0.02 - 0.0825 * s + 0.1625 * s * s;
}

void drawAxes(Svg& svg, const Chart& chart) {
    constexpr const char* kGrid = R"(stroke="#e2e8ec" stroke-width="1")";
    for (int i = -1; i <= 1; ++i) {
        const double y = 0.1 * i;
        svg.line(chart({0, y}), chart({1, y}), kGrid);
        svg.text(chart({0, y}) + glm::dvec2(-8, 4), fixed(i == 0 ? 0 : -y, 1), letters(12, "end"));
    }
    for (int i = 0; i <= 5; ++i) {
        const double x = 0.2 * i;
        svg.line(chart({x, -0.15}), chart({x, 0.15}), kGrid);
        svg.text(chart({x, 0.15}) + glm::dvec2(0, 16), fixed(x, 1), letters(12, "middle"));
    }
    svg.text(chart({0.5, 0.15}) + glm::dvec2(0, 34),
             "distance from the nose, BL",
             letters(12, "middle"));
    svg.text(chart({0, -0.15}) + glm::dvec2(-30, -6), "to the left, BL", letters(12));
}

}  // namespace

std::string drawMidlines(const FishBody& body, const ActionSegment& segment) {
    constexpr int kLines = 16;
    constexpr double kScale = 480;
    Svg svg(590, 220);
    const Chart chart{{60, 26}, {0, -0.15}, kScale};
    drawAxes(svg, chart);
    const std::vector<Midline> lines = midlinesOf(body, segment, kLines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::vector<glm::dvec2> points;
        for (std::size_t j = 0; j < lines[i].station.size(); ++j)
            points.emplace_back(lines[i].station[j], -lines[i].across[j]);
        // From dark to light through the beat, so that the wave's way can be seen.
        const int hue = 205;
        const int lightness = 22 + static_cast<int>(i) * 50 / kLines;
        svg.polyline(chart(points),
                     "fill=\"none\" stroke=\"hsl(" + std::to_string(hue) + ",45%," +
                         std::to_string(lightness) + "%)\" stroke-width=\"1.2\"");
    }
    for (const double side : {-1.0, 1.0}) {
        std::vector<glm::dvec2> envelope;
        for (int i = 0; i <= 40; ++i) {
            const double s = i / 40.0;
            envelope.emplace_back(s, side * saitheHalfSwing(s));
        }
        svg.polyline(chart(envelope),
                     R"(fill="none" stroke="#e08a2c" stroke-width="1.6" stroke-dasharray="5 4")");
    }
    return std::move(svg).finish();
}

}  // namespace aquarama
