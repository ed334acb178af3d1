// SPDX-License-Identifier: Apache-2.0
#include "calibration/light/seams.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <lcms2.h>

#include "calibration/hall/hall_view.h"
#include "common/base/picture.h"

namespace aquarama::light {

namespace {

cmsCIELab labOf(glm::dvec3 rgb, glm::dvec3 white) {
    const auto xyz = [](glm::dvec3 light) {
        return cmsCIEXYZ{glm::dot(light, {0.4124, 0.3576, 0.1805}),
                         luminance(light),
                         glm::dot(light, {0.0193, 0.1192, 0.9505})};
    };
    const cmsCIEXYZ colour = xyz(rgb), reference = xyz(white);
    cmsCIELab lab;
    cmsXYZ2Lab(&reference, &lab, &colour);
    return lab;
}

// The value at a point of a window, by a fit of second degree.
double smoothAt(std::span<const ProfilePoint> window, std::size_t at) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const double half = static_cast<double>(window.size()) / 2;
    for (std::size_t i = 0; i < window.size(); ++i) {
        const double x = (static_cast<double>(i) - static_cast<double>(at)) / half;
        const Eigen::Vector3d row(1, x, x * x);
        normal += row * row.transpose();
        right += window[i].luminance * row;
    }
    return normal.ldlt().solve(right)(0);
}

}  // namespace

double seamOf(std::span<const ProfilePoint> profile) {
    const std::size_t width = profile.size() / 8;
    if (width < 5) return 0;
    double seam = 0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const std::size_t first = std::min(i - std::min(i, width / 2), profile.size() - width);
        const auto window = profile.subspan(first, width);
        if (std::ranges::none_of(window, &ProfilePoint::isShared)) continue;
        const double smooth = smoothAt(window, i - first);
        seam = std::max(seam, std::abs(profile[i].luminance - smooth) / smooth);
    }
    return seam;
}

double colourDifference(glm::dvec3 one, glm::dvec3 other, glm::dvec3 white) {
    const cmsCIELab a = labOf(one, white), b = labOf(other, white);
    return cmsCIE2000DeltaE(&a, &b, 1, 1, 1);
}

namespace {

constexpr std::size_t kPoints = 480;  // of a profile
constexpr std::size_t kWithin = 3;    // samples across and down whose mean a point is

// A point of a profile along a row or column of the true screen: the mean of a square of samples as
// wide as the distance of points, as a luminance camera sees it.
struct LinePoint {
    std::vector<glm::dvec3> samples;
    int channels = 0;  // that light its middle
};
using Line = std::vector<LinePoint>;

LinePoint pointAt(const hall::TrueHall& truth, glm::dvec2 place, glm::dvec2 side) {
    LinePoint point;
    for (std::size_t i = 0; i < kWithin * kWithin; ++i) {
        const glm::dvec2 within =
            (glm::dvec2(i % kWithin, i / kWithin) + 0.5) / double{kWithin} - 0.5;
        if (const auto sample = truth.screen().at(place + side * within))
            point.samples.push_back(*sample);
    }
    if (point.samples.size() < kWithin * kWithin) return {};
    const glm::dvec3 middle = point.samples[point.samples.size() / 2];
    for (std::size_t c = 0; c < truth.channels(); ++c)
        point.channels += truth.pixelOf(c, middle) ? 1 : 0;
    return point;
}

// At a place of the other axis; empty where the screen is not there.
Line lineAlong(const hall::TrueHall& truth, int axis, double at) {
    const glm::dvec2 panorama(truth.rig().panoramaPixels);
    const double step = 1.0 / double{kPoints};
    const glm::dvec2 side(step, step * panorama.x / panorama.y);
    const auto count = static_cast<std::size_t>(1 / side[axis] + 1e-6);
    Line line;
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec2 place(at);
        place[axis] = (static_cast<double>(i) + 0.5) * side[axis];
        LinePoint point = pointAt(truth, place, side);
        if (!point.samples.empty()) line.push_back(std::move(point));
    }
    // Leaves out the edges of the screen, which may stay dark.
    const auto edge = static_cast<std::ptrdiff_t>(line.size() / 50 + 1);
    if (line.size() <= count / 2) return {};
    return {line.begin() + edge, line.end() - edge};
}

std::vector<Line> linesOf(const hall::TrueHall& truth) {
    std::vector<Line> lines;
    for (const int axis : {0, 1})
        for (const double at : {0.15, 0.3, 0.5, 0.7, 0.85})
            lines.push_back(lineAlong(truth, axis, at));
    return lines;
}

glm::dvec3 lightAt(const hall::LitScreen& lit, const LinePoint& point) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& sample : point.samples) sum += glm::dvec3(lit.at(sample));
    return sum / static_cast<double>(point.samples.size());
}

hall::LitScreen litBy(const hall::TrueHall& truth, const hall::DrawnWall& wall, glm::vec3 light) {
    return {truth, wall.pictures([light](glm::dvec3) { return light; })};
}

double worstSeam(const std::vector<Line>& lines, const hall::LitScreen& lit) {
    double worst = 0;
    for (const Line& line : lines) {
        std::vector<ProfilePoint> profile;
        for (const LinePoint& point : line)
            profile.push_back({luminance(lightAt(lit, point)), point.channels > 1});
        worst = std::max(worst, seamOf(profile));
    }
    return worst;
}

// Three points at each overlap of a line: before it, in it and behind it.
std::vector<std::array<const LinePoint*, 3>> crossings(const Line& line) {
    std::vector<std::array<const LinePoint*, 3>> found;
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (line[i].channels < 2 || line[i - 1].channels >= 2) continue;
        std::size_t end = i;
        while (end < line.size() && line[end].channels >= 2) ++end;
        const std::size_t aside = (end - i) / 4 + 1;
        if (i < aside || end + aside > line.size()) continue;
        found.push_back({&line[i - aside], &line[(i + end) / 2], &line[end + aside - 1]});
    }
    return found;
}

double colourSeam(const std::vector<Line>& lines,
                  const hall::LitScreen& lit,
                  const hall::LitScreen& white) {
    double sum = 0;
    std::size_t count = 0;
    for (const Line& line : lines)
        for (const auto& [before, middle, behind] : crossings(line)) {
            const glm::dvec3 reference = lightAt(white, *middle), inside = lightAt(lit, *middle);
            for (const LinePoint* point : {before, behind}) {
                const double fall = luminance(reference) / luminance(lightAt(white, *point));
                sum += colourDifference(inside, fall * lightAt(lit, *point), reference);
                ++count;
            }
        }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

Seams seamsOf(const hall::TrueHall& truth, const hall::DrawnWall& wall) {
    const std::vector<Line> lines = linesOf(truth);
    const hall::LitScreen white = litBy(truth, wall, glm::vec3(1));
    const hall::LitScreen grey = litBy(truth, wall, glm::vec3(0.18F));
    Seams seams{.grey2 = worstSeam(lines, litBy(truth, wall, glm::vec3(0.02F))),
                .grey18 = worstSeam(lines, grey),
                .grey100 = worstSeam(lines, white)};
    seams.colour = colourSeam(lines, grey, white) / 4;
    for (int c = 0; c < 3; ++c) {
        glm::vec3 primary(0);
        primary[c] = 0.5F;
        seams.colour += colourSeam(lines, litBy(truth, wall, primary), white) / 4;
    }
    return seams;
}

}  // namespace aquarama::light
