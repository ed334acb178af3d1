// SPDX-License-Identifier: Apache-2.0
#include "tests/support/panorama_measure.h"

#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "common/base/units.h"
#include "common/wall/pattern.h"
#include "common/wall/wall.h"

namespace aquarama::test {

namespace {

constexpr double kWindowDegrees = 1;     // to each side of a line; 10 sigma
constexpr double kKeepOffDegrees = 1.2;  // from crossing lines
constexpr int kSamplesPerLine = 400;
constexpr float kFaintest = 0.05F;  // of a minor line: less is not a line
constexpr float kNoise = 0.02F;     // of the peak

// One panorama seen along or across its rows: an upright line is crossed by walking a row.
struct Walk {
    const Light& light;
    bool upright;
    [[nodiscard]] float at(int across, int along) const {
        return upright ? light.at(across, along).y : light.at(along, across).y;
    }
};

// The light's centroid between two positions across a line.
std::optional<double> centroid(const Walk& walk, int from, int to, int along) {
    float peak = 0;
    for (int i = from; i <= to; ++i) peak = std::max(peak, walk.at(i, along));
    if (peak < kFaintest * static_cast<float>(wall::kGridMinorLight)) return std::nullopt;
    double sum = 0;
    double moment = 0;
    for (int i = from; i <= to; ++i) {
        const float light = walk.at(i, along);
        if (light < kNoise * peak) continue;
        sum += static_cast<double>(light);
        moment += static_cast<double>(light) * (i + 0.5);
    }
    return moment / sum;
}

// Panorama pixels of an azimuth or an elevation.
double columnOf(const config::Rig& rig, double degrees) {
    return (0.5 + degrees * kRadiansPerDegree<double> / rig.screen.arcRadians) *
           rig.panoramaPixels.x;
}
double rowOf(const config::Rig& rig, double degrees) {
    const double height = rig.screen.radiusMetres * std::tan(degrees * kRadiansPerDegree<double>);
    return (0.5 - height / rig.screen.heightMetres) * rig.panoramaPixels.y;
}
double azimuthAt(const config::Rig& rig, double column) {
    return (column / rig.panoramaPixels.x - 0.5) * rig.screen.arcRadians /
           kRadiansPerDegree<double>;
}
double elevationAt(const config::Rig& rig, double row) {
    const double height = (0.5 - row / rig.panoramaPixels.y) * rig.screen.heightMetres;
    return std::atan2(height, rig.screen.radiusMetres) / kRadiansPerDegree<double>;
}

double fromNearestLine(double degrees) {
    return std::abs(degrees - wall::kGridDegrees * std::round(degrees / wall::kGridDegrees));
}

struct Window {
    int from, to;
};

// All measurements of one line. `window` spans it across; `alongPixels` is its whole length.
void measureLine(const config::Rig& rig,
                 const Light& composed,
                 const Light& direct,
                 const LineOffset& line,
                 Window window,
                 std::vector<LineOffset>& found) {
    const int length = line.upright ? rig.panoramaPixels.y : rig.panoramaPixels.x;
    const int border = static_cast<int>(std::ceil(length * wall::kDarkBorder));
    const int step = std::max(1, length / kSamplesPerLine);
    for (int along = border; along < length - border; along += step) {
        const double crossing =
            line.upright ? elevationAt(rig, along + 0.5) : azimuthAt(rig, along + 0.5);
        if (fromNearestLine(crossing) < kKeepOffDegrees) continue;
        const auto truth = centroid({direct, line.upright}, window.from, window.to, along);
        const auto seen = centroid({composed, line.upright}, window.from, window.to, along);
        LineOffset offset = line;
        const double across = truth.value_or(window.from);
        offset.atPixels =
            line.upright ? glm::dvec2(across, along + 0.5) : glm::dvec2(along + 0.5, across);
        offset.offsetPixels =
            truth && seen ? *seen - *truth : std::numeric_limits<double>::infinity();
        found.push_back(offset);
    }
}

}  // namespace

std::vector<LineOffset> lineOffsets(const config::Rig& rig,
                                    const Light& composed,
                                    const Light& direct) {
    constexpr int kMostLines =
        static_cast<int>(90 / wall::kGridDegrees) - 1;  // to each side of level
    std::vector<LineOffset> found;
    for (const bool upright : {true, false})
        for (int i = -kMostLines; i <= kMostLines; ++i) {
            const double degrees = i * wall::kGridDegrees;
            const auto position = [&](double at) {
                return upright ? columnOf(rig, at) : rowOf(rig, -at);  // both grow with `at`
            };
            const Window window{static_cast<int>(std::floor(position(degrees - kWindowDegrees))),
                                static_cast<int>(std::ceil(position(degrees + kWindowDegrees)))};
            const int size = upright ? rig.panoramaPixels.x : rig.panoramaPixels.y;
            if (window.from < 0 || window.to >= size) continue;
            const LineOffset line{upright, upright ? degrees : -degrees, {}, 0};
            measureLine(rig, composed, direct, line, window, found);
        }
    return found;
}

namespace {

constexpr int kWindow = 9;  // pixels each way

// Sums over a window of both pictures.
struct WindowSums {
    glm::dmat2 slopes{0.0};       // of the direct one, products
    glm::dvec2 differences{0};    // slope times (composed - direct)
    double both = 0, square = 0;  // direct times composed, and itself
    double least = 1;             // direct
};

WindowSums sumsOf(const Light& composed, const Light& direct, glm::ivec2 corner) {
    WindowSums sums;
    const auto at = [](const Light& light, int x, int y) {
        return static_cast<double>(light.at(x, y).y);
    };
    for (int y = corner.y; y < corner.y + kWindow; ++y)
        for (int x = corner.x; x < corner.x + kWindow; ++x) {
            const double here = at(direct, x, y);
            const double shown = at(composed, x, y);
            const glm::dvec2 slope((at(direct, x + 1, y) - at(direct, x - 1, y)) / 2,
                                   (at(direct, x, y + 1) - at(direct, x, y - 1)) / 2);
            sums.slopes += glm::outerProduct(slope, slope);
            sums.differences += slope * (shown - here);
            sums.both += here * shown;
            sums.square += here * here;
            sums.least = std::min(sums.least, here);
        }
    return sums;
}

// Whether a rectangle has light everywhere.
bool isLit(const Light& screen, glm::ivec2 corner, glm::ivec2 size) {
    for (int y = corner.y; y < corner.y + size.y; ++y)
        for (int x = corner.x; x < corner.x + size.x; ++x)
            if (screen.at(x, y).y <= 0) return false;
    return true;
}

}  // namespace

std::vector<double> windowOffsets(const Light& composed, const Light& direct, const Light& screen) {
    constexpr double kLeastSlope = 0.5;   // squared, summed: a window that a line passes
    constexpr double kLeastSeen = 0.4;    // of the direct light, where the line ought to be
    constexpr double kMostBetween = 0.1;  // light between lines that are not run into one
    constexpr int kMargin = 3;
    std::vector<double> offsets;
    for (int y = kMargin; y + kWindow + kMargin < direct.sizePixels.y; y += kWindow)
        for (int x = kMargin; x + kWindow + kMargin < direct.sizePixels.x; x += kWindow) {
            const glm::ivec2 corner(x, y);
            if (!isLit(screen, corner - kMargin, glm::ivec2(kWindow + 2 * kMargin))) continue;
            const WindowSums sums = sumsOf(composed, direct, corner);
            // The direction in which the pattern changes most: across the line.
            const double trace = sums.slopes[0][0] + sums.slopes[1][1];
            if (trace < kLeastSlope || sums.least > kMostBetween) continue;
            const double angle =
                0.5 * std::atan2(2 * sums.slopes[0][1], sums.slopes[0][0] - sums.slopes[1][1]);
            const glm::dvec2 across(std::cos(angle), std::sin(angle));
            const double slope = glm::dot(across, sums.slopes * across);
            const bool isSeen = sums.both > kLeastSeen * sums.square;
            offsets.push_back(isSeen ? -glm::dot(across, sums.differences) / slope
                                     : std::numeric_limits<double>::infinity());
        }
    return offsets;
}

double unevennessOn(const Light& composed, const Light& screen) {
    constexpr int kMargin = 2;
    std::vector<double> pixels;
    double sum = 0;
    for (int y = kMargin; y + kMargin < screen.sizePixels.y; ++y)
        for (int x = kMargin; x + kMargin < screen.sizePixels.x; ++x) {
            if (!isLit(screen, glm::ivec2(x, y) - kMargin, glm::ivec2(1 + 2 * kMargin))) continue;
            pixels.push_back(static_cast<double>(composed.at(x, y).y));
            sum += pixels.back();
        }
    const double mean = sum / static_cast<double>(pixels.size());
    double worst = 0;
    for (const double pixel : pixels) worst = std::max(worst, std::abs(pixel / mean - 1));
    return worst;
}

double unevenness(const Light& panorama, int blockPixels) {
    const glm::ivec2 size = panorama.sizePixels;
    const glm::ivec2 border(glm::ceil(glm::dvec2(size) * wall::kDarkBorder));
    std::vector<double> blocks;
    double sum = 0;
    for (int top = border.y; top + blockPixels <= size.y - border.y; top += blockPixels)
        for (int left = border.x; left + blockPixels <= size.x - border.x; left += blockPixels) {
            double block = 0;
            for (int y = top; y < top + blockPixels; ++y)
                for (int x = left; x < left + blockPixels; ++x)
                    block += static_cast<double>(panorama.at(x, y).y);
            blocks.push_back(block);
            sum += block;
        }
    const double mean = sum / static_cast<double>(blocks.size());
    double worst = 0;
    for (const double block : blocks) worst = std::max(worst, std::abs(block / mean - 1));
    return worst;
}

}  // namespace aquarama::test
