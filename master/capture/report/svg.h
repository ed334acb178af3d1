// SPDX-License-Identifier: Apache-2.0
// The few marks that the report's pictures are made of.
#pragma once

#include <span>
#include <string>

#include <glm/vec2.hpp>

namespace aquarama::report {

// Presentation attributes as SVG spells them: R"(fill="none" stroke="#123")".
using SvgStyle = std::string;

class Svg {
  public:
    Svg(double width, double height);

    void rectangle(glm::dvec2 corner, glm::dvec2 size, const SvgStyle& style);
    void line(glm::dvec2 from, glm::dvec2 to, const SvgStyle& style);
    void polyline(std::span<const glm::dvec2> points, const SvgStyle& style);
    void polygon(std::span<const glm::dvec2> points, const SvgStyle& style);
    void circle(glm::dvec2 centre, double radius, const SvgStyle& style);
    void text(glm::dvec2 at, const std::string& words, const SvgStyle& style);

    [[nodiscard]] std::string finish() &&;

  private:
    void points(const char* element, std::span<const glm::dvec2> points, const SvgStyle& style);

    std::string out_;
};

[[nodiscard]] std::string fixed(double value, int digits);

}  // namespace aquarama::report
