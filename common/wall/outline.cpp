// SPDX-License-Identifier: Apache-2.0
#include "common/wall/outline.h"

#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

constexpr int kStepsPerSide = 2048;  // finer than a pixel

// Round the unit square, corners included.
template <class Visit>
void walkUnitSquare(Visit visit) {
    for (int i = 0; i <= kStepsPerSide; ++i) {
        const double t = static_cast<double>(i) / kStepsPerSide;
        visit(glm::dvec2(t, 0));
        visit(glm::dvec2(t, 1));
        visit(glm::dvec2(0, t));
        visit(glm::dvec2(1, t));
    }
}

}  // namespace

std::vector<glm::dvec3> litOutline(const config::Screen& screen,
                                   const Pinhole& projector,
                                   double spillMetres) {
    config::Screen spilled = screen;
    spilled.arcRadians += 2 * spillMetres / screen.radiusMetres;
    spilled.heightMetres += 2 * spillMetres;
    std::vector<glm::dvec3> outline;
    walkUnitSquare([&](glm::dvec2 t) {
        if (const auto point = screenHit(spilled, projector.ray(t * projector.size()), 0))
            outline.push_back(*point);
        const glm::dvec3 edge = screenPointAt(spilled, t);
        if (projector.pixelOf(edge) && lightsInside(projector, edge)) outline.push_back(edge);
    });
    return outline;
}

}  // namespace aquarama::wall
