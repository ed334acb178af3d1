// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "common/wall/pinhole.h"
#include "common/wall/wall.h"

namespace aquarama::wall {

std::optional<glm::dvec3> screenPoint(const config::Screen& screen,
                                      const config::Channel& channel,
                                      glm::dvec2 pixel) {
    return screenHit(screen, Pinhole(channel).ray(pixel), 0);
}

std::optional<glm::dvec2> projectorPixel(const config::Channel& channel,
                                         glm::dvec3 screenPointMetres) {
    return Pinhole(channel).pixelOf(screenPointMetres);
}

glm::dvec2 unrolled(const config::Screen& screen, glm::dvec3 point) {
    return {0.5 + azimuthOf(point) / screen.arcRadians, 0.5 - point.y / screen.heightMetres};
}

glm::dvec3 screenPointAt(const config::Screen& screen, glm::dvec2 position) {
    const double azimuth = (position.x - 0.5) * screen.arcRadians;
    return {screen.radiusMetres * std::sin(azimuth),
            (0.5 - position.y) * screen.heightMetres,
            -screen.radiusMetres * std::cos(azimuth)};
}

}  // namespace aquarama::wall
