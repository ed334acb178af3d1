// SPDX-License-Identifier: Apache-2.0
#include "tests/support/panorama_measure.h"

#include <cmath>
#include <limits>
#include <optional>

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
