// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/plot.h"

#include <array>
#include <cmath>

namespace aquarama::report {

namespace {

constexpr const char* kGrid = R"(stroke="#e6ecef" stroke-width="1")";
constexpr const char* kFrame = R"(fill="none" stroke="#9fb1bb" stroke-width="1")";

std::vector<double> ticksOf(const Axis& axis) {
    std::vector<double> ticks;
    const double rounding = axis.tick * 1e-6;
    for (double i = std::ceil((axis.least - rounding) / axis.tick);
         i * axis.tick <= axis.most + rounding;
         ++i)
        ticks.push_back(i == 0 ? 0 : i * axis.tick);
    return ticks;
}

}  // namespace

const char* colourOf(std::size_t action) {
    // Straight on in blues, turns in warm colours for the left and greens for the right.
    constexpr std::array kColours{
        "#7fb2d6", "#2f77b4", "#143d6b", "#e2a33b", "#bf4a24", "#7fb069", "#2e7d4f"};
    return kColours.at(action);
}

SvgStyle letters(int size, const char* anchor, const char* ink) {
    return "font-size=\"" + std::to_string(size) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
           ink + "\"";
}

SvgStyle stroke(const std::string& colour, double width) {
    return "fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + fixed(width, 1) + "\"";
}

Plot::Plot(glm::dvec2 corner, glm::dvec2 size, Axis x, Axis y)
    : corner_(corner), size_(size), x_(std::move(x)), y_(std::move(y)) {}

glm::dvec2 Plot::at(double x, double y) const {
    return {corner_.x + (x - x_.least) / (x_.most - x_.least) * size_.x,
            corner_.y + (y_.most - y) / (y_.most - y_.least) * size_.y};
}

std::vector<glm::dvec2> Plot::at(const std::vector<glm::dvec2>& points) const {
    std::vector<glm::dvec2> onPaper;
    onPaper.reserve(points.size());
    for (const glm::dvec2& point : points) onPaper.push_back(at(point.x, point.y));
    return onPaper;
}

void Plot::drawAxes(Svg& svg) const {
    for (const double x : ticksOf(x_)) {
        svg.line(at(x, y_.least), at(x, y_.most), kGrid);
        svg.text(at(x, y_.least) + glm::dvec2(0, 15), fixed(x, x_.digits), letters(11, "middle"));
    }
    for (const double y : ticksOf(y_)) {
        svg.line(at(x_.least, y), at(x_.most, y), kGrid);
        svg.text(at(x_.least, y) + glm::dvec2(-6, 4), fixed(y, y_.digits), letters(11, "end"));
    }
    svg.rectangle(corner_, size_, kFrame);
    svg.text({corner_.x + size_.x / 2, corner_.y + size_.y + 33}, x_.label, letters(12, "middle"));
    const glm::dvec2 side{corner_.x - 38, corner_.y + size_.y / 2};
    svg.text(side,
             y_.label,
             letters(12, "middle") + " transform=\"rotate(-90 " + fixed(side.x, 1) + " " +
                 fixed(side.y, 1) + ")\"");
}

void drawLegend(Svg& svg,
                glm::dvec2 at,
                const std::vector<std::pair<SvgStyle, std::string>>& entries) {
    for (const auto& [style, words] : entries) {
        svg.line(at, at + glm::dvec2(24, 0), style);
        svg.text(at + glm::dvec2(30, 4), words, letters(12));
        at.y += 18;
    }
}

}  // namespace aquarama::report
