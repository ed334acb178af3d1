// SPDX-License-Identifier: Apache-2.0
#include "common/wall/mark.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace aquarama::wall {

namespace {

// At a point of the screen's edge.
MarkPlace placeAt(const ScreenSurface& screen, glm::dvec3 edge) {
    constexpr double kStep = 0.002;  // of the panorama
    const glm::dvec2 place = screen.unrolled(edge);
    const auto inside = screen.at(place + kStep * (glm::dvec2(0.5) - place));
    MarkPlace mark{.edge = edge};
    if (!inside) return mark;
    mark.inwards = glm::normalize(*inside - edge);
    mark.along = glm::normalize(glm::cross(screen.normalAt(edge), mark.inwards));
    return mark;
}

}  // namespace

bool MarkPlace::covers(glm::dvec3 point, double movedMetres, double marginMetres) const {
    const glm::dvec3 off = point - at(0, movedMetres);
    const double in = glm::dot(off, inwards);
    return std::abs(glm::dot(off, along)) <= kMarkWidthMetres / 2 + marginMetres &&
           in >= -kMarkWidthMetres && in <= kMarkLengthMetres + marginMetres &&
           glm::length(off) < 2 * kMarkLengthMetres;
}

std::vector<MarkPlace> markPlaces(config::ScreenShape shape, const ScreenSurface& screen) {
    std::vector<MarkPlace> marks;
    if (shape != config::ScreenShape::Flat && shape != config::ScreenShape::Cylinder &&
        shape != config::ScreenShape::Dome)
        return marks;
    for (const double v : {0.0, 1.0})
        if (const auto edge = screen.at({0.5, v})) marks.push_back(placeAt(screen, *edge));
    return marks;
}

}  // namespace aquarama::wall
