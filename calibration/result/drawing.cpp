// SPDX-License-Identifier: Apache-2.0
#include "calibration/result/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace aquarama::result {

namespace {

// Codes of sRGB, 0 to 1: a grey that neither colour scale contains, so that nobody reads it as a
// value.
constexpr glm::vec3 kNoValue(0.55F, 0.57F, 0.6F);

// Converts codes of 8 bits (0 to 255) to codes from 0 to 1.
constexpr glm::vec3 bytes(int red, int green, int blue) {
    return {static_cast<float>(red) / 255,
            static_cast<float>(green) / 255,
            static_cast<float>(blue) / 255};
}

}  // namespace

// Six samples of matplotlib's viridis, at equal steps.
const ColourScale kGrowing{bytes(68, 1, 84),
                           bytes(65, 68, 135),
                           bytes(42, 120, 142),
                           bytes(34, 168, 132),
                           bytes(122, 209, 81),
                           bytes(253, 231, 37)};
// ColorBrewer's RdBu of six classes, turned round: it begins with blue.
const ColourScale kAround{bytes(33, 102, 172),
                          bytes(103, 169, 207),
                          bytes(209, 229, 240),
                          bytes(253, 219, 199),
                          bytes(239, 138, 98),
                          bytes(178, 24, 43)};

Field emptyField(glm::ivec2 sizePixels) {
    return {sizePixels,
            std::vector<double>(
                static_cast<std::size_t>(sizePixels.x) * static_cast<std::size_t>(sizePixels.y),
                std::numeric_limits<double>::quiet_NaN())};
}

// Magnitudes are compared: a negative value counts by its absolute value.
double largestOf(const Field& field) {
    double largest = 0;
    for (const double value : field.values)
        if (!std::isnan(value)) largest = std::max(largest, std::abs(value));
    return largest;
}

glm::vec3 colourAt(const ColourScale& scale, double share) {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(scale.size() - 1);
    const std::size_t low = std::min(static_cast<std::size_t>(place), scale.size() - 2);
    return glm::mix(
        scale[low], scale[low + 1], static_cast<float>(place - static_cast<double>(low)));
}

std::string cssColour(glm::vec3 codes) {
    const glm::ivec3 rounded(glm::round(codes * 255.0F));
    return fmt::format("rgb({} {} {})", rounded.x, rounded.y, rounded.z);
}

// Where `low` and `high` are equal, every value gets the first colour of the scale.
Picture colouredField(const Field& field, const ColourScale& scale, double low, double high) {
    Picture picture{.sizePixels = field.sizePixels, .bits = 8, .rgb = {}};
    for (const double value : field.values) {
        const double share = high > low ? (value - low) / (high - low) : 0;
        const glm::vec3 colour = std::isnan(value) ? kNoValue : colourAt(scale, share);
        for (int c = 0; c < 3; ++c)
            picture.rgb.push_back(static_cast<std::uint16_t>(std::lround(colour[c] * 255)));
    }
    return picture;
}

// RFC 4648, with padding and without line breaks.
std::string base64(std::span<const std::byte> content) {
    constexpr const char* kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((content.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < content.size(); i += 3) {
        const std::size_t there = std::min<std::size_t>(3, content.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8U | (k < there ? std::to_integer<std::uint32_t>(content[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= there ? kLetters[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

std::string dataUri(const Picture& picture) {
    return "data:image/png;base64," + base64(encodePng({.sizePixels = picture.sizePixels,
                                                        .components = 3,
                                                        .bits = picture.bits,
                                                        .codes = picture.rgb},
                                                       PngMeaning::Srgb));
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

// The picture is stretched to the full width and to `height`; its pixels need not be square.
std::string drawing(const Picture& picture,
                    double height,
                    const std::string& overlay,
                    const std::string& title) {
    return fmt::format(
        "<svg viewBox=\"0 0 {0:.0f} {1:.1f}\" role=\"img\" aria-label=\"{2}\">"
        "<image href=\"{3}\" width=\"{0:.0f}\" height=\"{1:.1f}\" preserveAspectRatio=\"none\"/>"
        "{4}</svg>\n",
        kDrawingWidth,
        height,
        escaped(title),
        dataUri(picture),
        overlay);
}

std::string line(const std::vector<glm::dvec2>& points, const std::string& colour) {
    std::string text = fmt::format("<polyline fill=\"none\" stroke=\"{}\" points=\"", colour);
    for (const glm::dvec2& point : points) text += fmt::format("{:.1f},{:.1f} ", point.x, point.y);
    return text + "\"/>";
}

// CSS interpolates linearly between the colours, as colourAt() does.
std::string scaleBar(const ColourScale& scale, const std::string& low, const std::string& high) {
    std::string stops;
    for (const glm::vec3& colour : scale) stops += ", " + cssColour(colour);
    return fmt::format(
        "<p class=\"scale\">{} <span style=\"background: linear-gradient(to right{})\"></span> "
        "{}</p>\n",
        escaped(low),
        stops,
        escaped(high));
}

namespace {

// Units of the SVG drawing. The space left of kPlotLeft holds the labels of the axis.
constexpr double kPlotHeight = 260, kPlotLeft = 80, kPlotRight = 990, kPlotTop = 24,
                 kPlotBottom = 230;

// The vertical place of a value, in units of the drawing, which grow downwards. Values outside 0 to
// `most` lie on the edge.
double plotted(double value, double most) {
    return kPlotBottom - (kPlotBottom - kPlotTop) * std::clamp(value / most, 0.0, 1.0);
}

// Horizontal lines at equal steps from 0 to `most`, each with its value at the left.
std::string axis(double most, int ticks) {
    std::string text;
    for (int i = 0; i <= ticks; ++i) {
        const double value = most * i / ticks, y = plotted(value, most);
        text += fmt::format(
            "<line class=\"tick\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
            "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3g}</text>",
            kPlotLeft,
            kPlotRight,
            y,
            y,
            kPlotLeft - 8,
            y + 5,
            value);
    }
    return text;
}

// Each value lies in the middle of its step, as the centre of a pixel does.
std::string curveLine(const Curve& curve, double most) {
    std::vector<glm::dvec2> points;
    const double step = (kPlotRight - kPlotLeft) /
                        static_cast<double>(std::max<std::size_t>(1, curve.values.size()));
    for (std::size_t i = 0; i < curve.values.size(); ++i)
        points.emplace_back(kPlotLeft + step * (static_cast<double>(i) + 0.5),
                            plotted(curve.values[i], most));
    return line(points, curve.colour);
}

}  // namespace

// Values above `most` are drawn at the top edge. The names of the curves follow below the drawing.
std::string plot(const std::vector<Curve>& curves,
                 double most,
                 int ticks,
                 const std::string& title) {
    std::string text = fmt::format(
        "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
        "aria-label=\"{}\">{}",
        kDrawingWidth,
        kPlotHeight,
        escaped(title),
        axis(most, ticks));
    std::string names;
    for (const Curve& curve : curves) {
        text += curveLine(curve, most);
        names += fmt::format(
            "<span><i style=\"background: {}\"></i>{}</span>", curve.colour, escaped(curve.name));
    }
    return text + "</svg>\n<p class=\"names\">" + names + "</p>\n";
}

}  // namespace aquarama::result
