// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

#include "calibration/theatre/room.h"
#include "common/wall/wall.h"

namespace aquarama::theatre {

namespace {

constexpr glm::ivec2 kLamps(24, 6);

// The mean of the panorama under each cell of a coarse grid.
wall::Light coarsened(const wall::Light& fine, glm::ivec2 cells) {
    wall::Light coarse = wall::darkness(cells);
    wall::Light counts = wall::darkness(cells);  // of pixels in each
    for (int y = 0; y < fine.sizePixels.y; ++y)
        for (int x = 0; x < fine.sizePixels.x; ++x) {
            const glm::ivec2 cell = glm::ivec2(x, y) * cells / fine.sizePixels;
            coarse.at(cell.x, cell.y) += fine.at(x, y);
            counts.at(cell.x, cell.y).x += 1;
        }
    for (std::size_t i = 0; i < coarse.rgb.size(); ++i)
        coarse.rgb[i] /= std::max(1.0F, counts.rgb[i].x);
    return coarse;
}

}  // namespace

ScreenGlow::ScreenGlow(const config::Screen& screen, const wall::Light& panorama)
    : coarse_(coarsened(panorama, kLamps)) {
    const double squareMetres =
        screen.radiusMetres * screen.arcRadians * screen.heightMetres / (kLamps.x * kLamps.y);
    for (int y = 0; y < kLamps.y; ++y)
        for (int x = 0; x < kLamps.x; ++x) {
            const glm::dvec3 centre =
                wall::screenPointAt(screen, glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(kLamps));
            const glm::dvec3 facing = glm::normalize(glm::dvec3(-centre.x, 0, -centre.z));
            lamps_.push_back({centre, facing, squareMetres, coarse_.at(x, y)});
            mean_ += coarse_.at(x, y) / float{kLamps.x * kLamps.y};
        }
}

// Lambert's two cosines over pi r^2; the lamp's own area under the fraction keeps it finite nearby.
glm::vec3 ScreenGlow::on(glm::dvec3 point, glm::dvec3 normal) const {
    glm::vec3 sum(0);
    for (const Lamp& lamp : lamps_) {
        const glm::dvec3 way = lamp.centre - point;
        const double cosines = -glm::dot(lamp.facing, way) * glm::dot(normal, way);
        if (cosines <= 0 || glm::dot(normal, way) <= 0) continue;
        const double square = glm::dot(way, way);
        const double share = cosines * lamp.squareMetres /
                             (square * (std::numbers::pi * square + lamp.squareMetres));
        sum += static_cast<float>(share) * lamp.light;
    }
    return sum;
}

glm::vec3 ScreenGlow::blurred(glm::dvec2 position) const {
    return wall::bilinear(coarse_, position * glm::dvec2(kLamps));
}

}  // namespace aquarama::theatre
