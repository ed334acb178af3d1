// SPDX-License-Identifier: Apache-2.0
// Axes with ticks and units, and what the report's pictures share.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "master/capture/report/svg.h"

namespace aquarama::report {

inline constexpr const char* kInk = "#1d2b36";
inline constexpr const char* kQuietInk = "#5b7280";
inline constexpr const char* kAmber = "#a9641a";  // words about what was published
inline constexpr const char* kPublishedStyle =
    R"(fill="none" stroke="#e08a2c" stroke-width="1.8" stroke-dasharray="6 4")";

// One colour a segment, in the order of the actions, in every picture and table.
[[nodiscard]] const char* colourOf(std::size_t action);

[[nodiscard]] SvgStyle letters(int size, const char* anchor = "start", const char* ink = kInk);
[[nodiscard]] SvgStyle stroke(const std::string& colour, double width);

struct Axis {
    double least = 0, most = 1;
    double tick = 0.2;
    int digits = 1;
    std::string label;  // with its unit
};

// A rectangle of the paper with x to the right and y up.
class Plot {
  public:
    Plot(glm::dvec2 corner, glm::dvec2 size, Axis x, Axis y);

    [[nodiscard]] glm::dvec2 at(double x, double y) const;  // on the paper
    [[nodiscard]] std::vector<glm::dvec2> at(const std::vector<glm::dvec2>& points) const;
    void drawAxes(Svg& svg) const;  // and a grid behind what is drawn later

  private:
    glm::dvec2 corner_, size_;
    Axis x_, y_;
};

// A line of each style with its words, one below the other.
void drawLegend(Svg& svg,
                glm::dvec2 at,
                const std::vector<std::pair<SvgStyle, std::string>>& entries);

}  // namespace aquarama::report
