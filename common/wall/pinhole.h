// SPDX-License-Identifier: Apache-2.0
// A projector made ready for many pixels: rays out of it, points into it, and what its light
// reaches on a screen.
#pragma once

#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"

namespace aquarama::wall {

struct Ray {
    glm::dvec3 origin{};  // wall frame, metres
    glm::dvec3 direction{};
};

class Pinhole {
  public:
    explicit Pinhole(const config::Channel& channel);

    [[nodiscard]] Ray ray(glm::dvec2 pixel) const;
    // Nothing where the point is outside the picture or behind the projector.
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const;
    [[nodiscard]] glm::dvec2 size() const { return size_; }
    [[nodiscard]] glm::dvec3 position() const { return position_; }

  private:
    glm::dmat3 wallFromProjector_;
    glm::dvec3 position_;
    glm::dvec2 focal_, principal_, size_;
};

// Where a ray from the audience's side meets the screen's inside; nothing where it passes the
// screen's edges by more than `spillMetres`.
[[nodiscard]] std::optional<glm::dvec3> screenHit(const config::Screen& screen,
                                                  const Ray& ray,
                                                  double spillMetres);

// Whether the projector stands on the audience's side of the screen at this point of it.
[[nodiscard]] bool lightsInside(const Pinhole& projector, glm::dvec3 screenPointMetres);

// Azimuth of a point about the screen's axis: 0 straight ahead, positive to the right.
[[nodiscard]] double azimuthOf(glm::dvec3 point);

// The border of what a projector lights on the screen, as a closely spaced set of points.

// Points where the picture's border falls on the screen and where the screen's border falls into
// the picture: together they enclose all that is lit. Empty when the projector misses the screen.
[[nodiscard]] std::vector<glm::dvec3> litOutline(const config::Screen& screen,
                                                 const Pinhole& projector,
                                                 double spillMetres);

}  // namespace aquarama::wall
