// SPDX-License-Identifier: Apache-2.0
// Geometry of one projector and the screen: rays out of it, points into it, and what its light
// reaches on the screen. Wall frame: metres; y up along the screen's axis, -z from the axis to its
// middle.
#pragma once

#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"

namespace aquarama::wall {

// The direction need not be of unit length.
struct Ray {
    glm::dvec3 origin{};  // wall frame, metres
    glm::dvec3 direction{};
};

// A projector as a pinhole camera without distortion, with its rotation computed once, for many
// pixels. Immutable.
class Pinhole {
  public:
    // Focal lengths of the channel must be positive.
    explicit Pinhole(const config::Channel& channel);

    // The light of a place in the picture (continuous, top left corner at (0, 0)). One unit along
    // the direction is one metre along the optical axis.
    [[nodiscard]] Ray ray(glm::dvec2 pixel) const;
    // The place in the picture that lights a point; nothing where that is outside of the picture or
    // behind the projector. Does not ask whether the screen is in between.
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const;
    // Of the picture, in pixels.
    [[nodiscard]] glm::dvec2 size() const { return size_; }
    [[nodiscard]] glm::dvec3 position() const { return position_; }

  private:
    // Projector frame: x right, y up, looking along -z. Focal lengths, principal point and size in
    // pixels.
    glm::dmat3 wallFromProjector_;
    glm::dvec3 position_;
    glm::dvec2 focal_, principal_, size_;
};

// Where a ray from the audience's side meets the inside of the screen; nothing where it passes the
// screen's edges by more than `spillMetres`.
[[nodiscard]] std::optional<glm::dvec3> screenHit(const config::Screen& screen,
                                                  const Ray& ray,
                                                  double spillMetres);

// Whether the projector stands on the audience's side of the screen at this point of it, so that
// its light falls on the inside.
[[nodiscard]] bool lightsInside(const Pinhole& projector, glm::dvec3 screenPointMetres);

// Azimuth of a point about the screen's axis, in radians: 0 straight ahead, positive to the right.
[[nodiscard]] double azimuthOf(glm::dvec3 point);

// The border of what a projector lights on the screen, as a dense set of points in no order: where
// the picture's border falls on the screen, and where the screen's border falls into the picture.
// Together they enclose all that is lit. Empty when the projector misses the screen.
[[nodiscard]] std::vector<glm::dvec3> litOutline(const config::Screen& screen,
                                                 const Pinhole& projector,
                                                 double spillMetres);

}  // namespace aquarama::wall
