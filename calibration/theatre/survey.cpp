// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/survey.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/units/units.h"
#include "common/wall/pinhole.h"
#include "common/wall/wall.h"

namespace aquarama::theatre {

namespace {

constexpr int kAlong = 12001;  // samples of the screen's mid-height; a hundredth of a degree each

double degreesAt(glm::dvec3 point) {
    return wall::azimuthOf(point) / kRadiansPerDegree<double>;
}

// How much of this projector's picture a neighbour lights too, at mid-height.
ChannelOverlap overlapOf(const config::Screen& screen,
                         const wall::Pinhole& own,
                         const config::Channel& neighbour) {
    const wall::Pinhole other(neighbour);
    ChannelOverlap overlap;
    overlap.with = neighbour.name;
    glm::dvec2 lastPixel{};
    double lastDegrees = 0;
    bool inside = false;
    for (int i = 0; i < kAlong; ++i) {
        const glm::dvec3 point =
            wall::screenPointAt(screen, {static_cast<double>(i) / (kAlong - 1), 0.5});
        const auto pixel = own.pixelOf(point);
        const bool shared = pixel && other.pixelOf(point) && wall::lightsInside(own, point) &&
                            wall::lightsInside(other, point);
        if (shared && inside) {
            overlap.pixels += std::abs(pixel->x - lastPixel.x);
            overlap.degrees += degreesAt(point) - lastDegrees;
        }
        inside = shared;
        if (shared) lastPixel = *pixel;
        lastDegrees = degreesAt(point);
    }
    return overlap;
}

// Pixels per degree as seen from the sweet spot, by the closest thing to a derivative.
glm::dvec2 densityAt(const config::Screen& screen,
                     const wall::Pinhole& projector,
                     glm::dvec2 unrolledPosition) {
    constexpr double kStep = 1e-4;
    const auto here = projector.pixelOf(wall::screenPointAt(screen, unrolledPosition));
    const auto right =
        projector.pixelOf(wall::screenPointAt(screen, unrolledPosition + glm::dvec2(kStep, 0)));
    const auto down =
        projector.pixelOf(wall::screenPointAt(screen, unrolledPosition + glm::dvec2(0, kStep)));
    if (!here || !right || !down) return {};
    const double degreesRight = kStep * screen.arcRadians / kRadiansPerDegree<double>;
    const double degreesDown =
        std::atan(kStep * screen.heightMetres / screen.radiusMetres) / kRadiansPerDegree<double>;
    return {(right->x - here->x) / degreesRight, (down->y - here->y) / degreesDown};
}

std::string sideways(double degrees) {
    char text[48];
    std::snprintf(
        text, sizeof text, "%.1f deg %s", std::abs(degrees), degrees < 0 ? "left" : "right");
    return text;
}

}  // namespace

ChannelSurvey surveyChannel(const config::Rig& rig, std::size_t channel) {
    const wall::Pinhole own(rig.channels[channel]);
    const std::vector<glm::dvec3> lit = wall::litOutline(rig.screen, own, 0);
    const auto [left, right] = std::ranges::minmax(lit, {}, wall::azimuthOf);
    const auto [bottom, top] = std::ranges::minmax(lit, {}, &glm::dvec3::y);
    ChannelSurvey survey;
    survey.name = rig.channels[channel].name;
    survey.leftDegrees = degreesAt(left);
    survey.rightDegrees = degreesAt(right);
    survey.bottomMetres = bottom.y;
    survey.topMetres = top.y;
    const double u = (wall::unrolled(rig.screen, left).x + wall::unrolled(rig.screen, right).x) / 2;
    const double v = (wall::unrolled(rig.screen, bottom).y + wall::unrolled(rig.screen, top).y) / 2;
    survey.pixelsPerDegree = densityAt(rig.screen, own, {u, v});
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        if (i == channel) continue;
        const ChannelOverlap overlap = overlapOf(rig.screen, own, rig.channels[i]);
        if (overlap.pixels > 0) survey.overlaps.push_back(overlap);
    }
    return survey;
}

double worstBlendSum(const config::Rig& rig) {
    const wall::Blend blend(rig);
    constexpr glm::ivec2 kGrid(601, 151);
    double worst = 0;
    for (int y = 0; y < kGrid.y; ++y)
        for (int x = 0; x < kGrid.x; ++x) {
            const glm::dvec2 t = glm::dvec2(x, y) / glm::dvec2(kGrid - 1);
            const glm::dvec2 at = wall::kDarkBorder + (1 - 2 * wall::kDarkBorder) * t;
            double sum = 0;
            for (std::size_t i = 0; i < rig.channels.size(); ++i)
                sum += blend.weight(i, wall::screenPointAt(rig.screen, at));
            worst = std::max(worst, std::abs(sum - 1));
        }
    return worst;
}

std::string oneLine(const ChannelSurvey& survey) {
    char numbers[128];
    std::snprintf(numbers,
                  sizeof numbers,
                  ", %+.2f to %+.2f m; %.1f x %.1f px per degree",
                  survey.bottomMetres,
                  survey.topMetres,
                  survey.pixelsPerDegree.x,
                  survey.pixelsPerDegree.y);
    std::string line = survey.name + ": lights " + sideways(survey.leftDegrees) + " to " +
                       sideways(survey.rightDegrees) + numbers;
    for (const ChannelOverlap& overlap : survey.overlaps) {
        std::snprintf(numbers,
                      sizeof numbers,
                      "; blends over %.0f px (%.1f deg) with ",
                      overlap.pixels,
                      overlap.degrees);
        line += numbers + overlap.with;
    }
    return line;
}

}  // namespace aquarama::theatre
