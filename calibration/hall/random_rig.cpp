// SPDX-License-Identifier: Apache-2.0
// Random rigs whose projectors light all of a screen of any shape. The panorama is divided into
// cells, and the lens of each projector is chosen so that its picture just covers its cell.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "calibration/hall/chance.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/true_lens.h"
#include "common/base/units.h"
#include "common/wall/surface.h"

namespace aquarama::hall {

namespace {

// How much of its own size a picture reaches past the screen's edges.
constexpr double kOvershoot = 0.07;

// A part of the panorama.
struct Cell {
    glm::dvec2 low{}, high{};
    [[nodiscard]] glm::dvec2 middle() const { return (low + high) / 2.0; }
};

// The random values of a rig.
struct Plan {
    config::Screen screen;
    std::vector<int> rows;  // columns of each, from the top
    glm::ivec2 pixels{};    // of a projector
    double overlap = 0;     // of a cell's size
    double throwRatio = 0;  // distance over width
};

int mostColumns(const Plan& plan) {
    return *std::ranges::max_element(plan.rows);
}

// Of a picture of this width, so that the cells have the shape of the pictures.
double screenHeight(const Plan& plan, double cellWidth) {
    const double shape = double(plan.pixels.y) / plan.pixels.x;
    const double rows = double(plan.rows.size());
    const double picture = cellWidth * (1 + plan.overlap) * shape;
    return rows * picture / (1 + (rows > 1 ? plan.overlap : 0.0) + 2 * kOvershoot);
}

Plan cylinderPlan(Chance& chance) {
    Plan plan;
    const int columns = 3 + chance.below(3);
    plan.rows = {columns};
    plan.screen.radiusMetres = chance.between(2.2, 4.0);
    plan.screen.arcRadians = chance.between(24, 31) * columns * kDegree;
    plan.screen.arcRadians = std::min(plan.screen.arcRadians, 115 * kDegree);
    return plan;
}

void finishCylinder(Plan& plan) {
    const double arc = plan.screen.arcRadians * plan.screen.radiusMetres;
    plan.screen.heightMetres = 0.95 * screenHeight(plan, arc / mostColumns(plan));
}

Plan flatPlan(Chance& chance) {
    Plan plan;
    plan.screen.shape = config::ScreenShape::Flat;
    constexpr std::array<std::array<int, 2>, 4> kGrids{{{3, 1}, {4, 1}, {2, 2}, {3, 2}}};
    const auto& grid = kGrids[static_cast<std::size_t>(chance.below(4))];
    plan.rows.assign(static_cast<std::size_t>(grid[1]), grid[0]);
    plan.screen.widthMetres = grid[0] * chance.between(1.6, 2.4);
    plan.screen.distanceMetres = plan.screen.widthMetres * chance.between(0.55, 0.8);
    return plan;
}

Plan domePlan(Chance& chance) {
    Plan plan;
    plan.screen.shape = config::ScreenShape::Dome;
    const int channels = 3 + chance.below(4);
    plan.rows = {channels / 2, channels - channels / 2};
    if (channels == 6) plan.rows = {2, 2, 2};  // cells of the pictures' shape
    plan.screen.radiusMetres = chance.between(2.5, 5.0);
    plan.screen.arcRadians = chance.between(90, 120) * kDegree;
    plan.screen.tiltRadians = chance.between(55, 80) * kDegree;
    return plan;
}

Plan drawPlan(Chance& chance) {
    const int kind = chance.below(3);
    Plan plan = kind == 0 ? cylinderPlan(chance) : kind == 1 ? flatPlan(chance) : domePlan(chance);
    plan.pixels = chance.below(2) == 0 ? glm::ivec2(1920, 1200) : glm::ivec2(1400, 1050);
    plan.overlap = chance.between(0.12, 0.25);
    plan.throwRatio = chance.between(1.2, 1.9);
    if (kind == 0) finishCylinder(plan);
    if (kind == 1)
        plan.screen.heightMetres = screenHeight(plan, plan.screen.widthMetres / mostColumns(plan));
    return plan;
}

// The cell with half of the overlap at shared edges, and the overshoot at the edges of the screen.
Cell cellOf(const Plan& plan, std::size_t row, int column) {
    const glm::dvec2 size(1.0 / plan.rows[row], 1.0 / double(plan.rows.size()));
    Cell cell;
    cell.low = size * glm::dvec2(column, row);
    cell.high = cell.low + size;
    for (int axis = 0; axis < 2; ++axis) {
        cell.low[axis] -= size[axis] * (cell.low[axis] < 1e-9 ? kOvershoot : plan.overlap / 2);
        cell.high[axis] +=
            size[axis] * (cell.high[axis] > 1 - 1e-9 ? kOvershoot : plan.overlap / 2);
    }
    return cell;
}

// The screen with a margin on all sides of this share of it.
std::unique_ptr<const wall::ScreenSurface> enlarged(const config::Screen& screen, double margin) {
    config::Rig rig;
    rig.screen = screen;
    rig.screen.arcRadians *= 1 + 2 * margin;
    rig.screen.widthMetres *= 1 + 2 * margin;
    rig.screen.heightMetres *= 1 + 2 * margin;
    return wall::makeSurface(rig);
}

// Points of a cell, past the screen's edges too.
std::vector<glm::dvec3> pointsOf(const Cell& cell, const config::Screen& screen) {
    constexpr double kMargin = 0.1;
    constexpr int kSteps = 24;
    const auto surface = enlarged(screen, kMargin);
    std::vector<glm::dvec3> points;
    for (int y = 0; y <= kSteps; ++y)
        for (int x = 0; x <= kSteps; ++x) {
            const glm::dvec2 place =
                glm::mix(cell.low, cell.high, glm::dvec2(x, y) / double{kSteps});
            const auto point = surface->at((place + kMargin) / (1 + 2 * kMargin));
            // Of a dome's square panorama not the corners.
            if (point) points.push_back(*point);
        }
    return points;
}

// Level with the panorama's rows at the middle of its cell.
glm::dmat3 facing(const wall::ScreenSurface& surface, glm::dvec2 place, glm::dvec3 back) {
    constexpr double kStep = 1e-3;
    const auto left = surface.at(place - glm::dvec2(kStep, 0));
    const auto right = surface.at(place + glm::dvec2(kStep, 0));
    const glm::dvec3 up = glm::normalize(glm::cross(back, *right - *left));
    return {glm::cross(up, back), up, back};
}

glm::dvec2 tangentOf(const config::Projector& projector, glm::dvec3 point) {
    const glm::dmat3 wallFromLens = wall::turned(projector.yawPitchRollRadians);
    const glm::dvec3 seen = (point - projector.positionMetres) * wallFromLens;
    return glm::dvec2(seen.x, -seen.y) / -seen.z;
}

// Sets the lens so that its picture covers the points. `inwards`: the side where the picture may be
// larger.
void fitLens(config::Projector& projector,
             glm::dvec2 pixels,
             const std::vector<glm::dvec3>& points,
             glm::dvec3 inwards) {
    constexpr double kInwards = 0.7;  // of the room that the picture has round the points
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::dvec3& point : points) {
        low = glm::min(low, tangentOf(projector, point));
        high = glm::max(high, tangentOf(projector, point));
    }
    const glm::dvec2 middle = (low + high) / 2.0, size = high - low;
    const double focal = std::min(pixels.x / size.x, pixels.y / size.y);
    const glm::dvec2 free = kInwards * (pixels / focal - size) / 2.0;
    const glm::dvec2 way = tangentOf(projector, inwards) - middle;
    projector.focalPixels = glm::dvec2(focal);
    projector.principalPixels = pixels / 2.0 - focal * (middle + glm::clamp(way, -free, free));
}

// The projector hangs before the middle of its cell and above it, with a shifted lens. It lies on
// its side where the cell of a dome is higher than wide.
config::Projector projectorOf(const Plan& plan, const Cell& cell, Chance& chance) {
    const auto surface = enlarged(plan.screen, 0);
    const std::vector<glm::dvec3> points = pointsOf(cell, plan.screen);
    const glm::dvec3 middle = *surface->at(cell.middle());
    double width = 0;
    for (const glm::dvec3& point : points)
        width = std::max(width, 1.7 * glm::length(point - middle));
    const glm::dvec3 back = glm::normalize(surface->normalAt(middle));
    glm::dmat3 wallFromLens = facing(*surface, cell.middle(), back);
    const bool isDome = plan.screen.shape == config::ScreenShape::Dome;
    config::Projector projector;
    projector.positionMetres = middle + plan.throwRatio * width * back +
                               chance.between(0.15, 0.35) * width * wallFromLens[1];
    const glm::dvec2 size = cell.high - cell.low;
    if (isDome && size.y > 1.2 * size.x) wallFromLens = {wallFromLens[1], -wallFromLens[0], back};
    projector.yawPitchRollRadians = anglesOf(wallFromLens);
    // A dome's cells are not of the pictures' shape, and at its edge there is little to light.
    fitLens(projector, plan.pixels, points, isDome ? *surface->at(glm::dvec2(0.5)) : middle);
    return projector;
}

config::Channel channelOf(std::size_t index, glm::ivec2 pixels, double scale) {
    config::Channel channel;
    channel.id = static_cast<std::uint32_t>(index);
    channel.name = fmt::format("p{}", index);
    channel.sizePixels = glm::round(glm::dvec2(pixels) * scale);
    channel.display.windowPosition = {static_cast<int>(index) * channel.sizePixels.x, 0};
    return channel;
}

// The panorama is as fine as the projectors' pixels in the middles of their pictures, up to 4000
// pixels wide.
glm::ivec2 panoramaPixels(const config::Rig& rig, double scale) {
    const auto surface = wall::makeSurface(rig);
    const glm::dvec3 centre = *surface->at({0.5, 0.5});
    constexpr double kStep = 1e-4;
    const double across = glm::length(*surface->at({0.5 + kStep, 0.5}) - centre) / kStep;
    const double down = glm::length(*surface->at({0.5, 0.5 + kStep}) - centre) / kStep;
    const config::Channel& first = rig.channels.front();
    const double metres = glm::length(first.projector.positionMetres - *surface->at({0.5, 0.5}));
    const double width = std::min(4000 * scale, across * first.projector.focalPixels.x / metres);
    return glm::ivec2(glm::round(glm::dvec2(width, width * down / across)));
}

}  // namespace

config::Rig randomRig(std::uint32_t seed, double scale) {
    Chance chance(hashOf(seed, 1));
    const Plan plan = drawPlan(chance);
    config::Rig rig;
    rig.name = fmt::format("random_{}", seed);
    rig.screen = plan.screen;
    rig.timing = {.refreshHertz = 60, .presentDeadlineSeconds = 2, .membershipSeconds = 5};
    for (std::size_t row = 0; row < plan.rows.size(); ++row)
        for (int column = 0; column < plan.rows[row]; ++column) {
            config::Channel channel = channelOf(rig.channels.size(), plan.pixels, scale);
            channel.projector = projectorOf(plan, cellOf(plan, row, column), chance);
            const glm::dvec2 shrink = glm::dvec2(channel.sizePixels) / glm::dvec2(plan.pixels);
            channel.projector.focalPixels *= shrink;
            channel.projector.principalPixels *= shrink;
            rig.channels.push_back(channel);
        }
    rig.panoramaPixels = panoramaPixels(rig, scale);
    return rig;
}

}  // namespace aquarama::hall
