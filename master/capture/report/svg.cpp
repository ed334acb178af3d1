// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/svg.h"

#include <array>
#include <cstdio>
#include <utility>

namespace aquarama::report {

std::string fixed(double value, int digits) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

namespace {

std::string pair(const char* x, const char* y, glm::dvec2 value) {
    return std::string(x) + "=\"" + fixed(value.x, 2) + "\" " + y + "=\"" + fixed(value.y, 2) +
           "\" ";
}

}  // namespace

Svg::Svg(double width, double height) {
    const std::string size = fixed(width, 0) + " " + fixed(height, 0);
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + pair("width", "height", {width, height}) +
           "viewBox=\"0 0 " + size + "\" font-family=\"Helvetica, Arial, sans-serif\">\n" +
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

void Svg::rectangle(glm::dvec2 corner, glm::dvec2 size, const SvgStyle& style) {
    out_ += "<rect " + pair("x", "y", corner) + pair("width", "height", size) + style + "/>\n";
}

void Svg::line(glm::dvec2 from, glm::dvec2 to, const SvgStyle& style) {
    out_ += "<line " + pair("x1", "y1", from) + pair("x2", "y2", to) + style + "/>\n";
}

void Svg::polyline(std::span<const glm::dvec2> at, const SvgStyle& style) {
    points("polyline", at, style);
}

void Svg::polygon(std::span<const glm::dvec2> at, const SvgStyle& style) {
    points("polygon", at, style);
}

void Svg::points(const char* element, std::span<const glm::dvec2> at, const SvgStyle& style) {
    out_ += std::string("<") + element + " points=\"";
    for (const glm::dvec2& point : at) out_ += fixed(point.x, 2) + "," + fixed(point.y, 2) + " ";
    out_ += "\" " + style + "/>\n";
}

void Svg::circle(glm::dvec2 centre, double radius, const SvgStyle& style) {
    out_ +=
        "<circle " + pair("cx", "cy", centre) + "r=\"" + fixed(radius, 2) + "\" " + style + "/>\n";
}

void Svg::text(glm::dvec2 at, const std::string& words, const SvgStyle& style) {
    out_ += "<text " + pair("x", "y", at) + style + ">" + words + "</text>\n";
}

std::string Svg::finish() && {
    return std::move(out_) + "</svg>\n";
}

}  // namespace aquarama::report
