// SPDX-License-Identifier: Apache-2.0
// The true lens of a projector or a camera, with terms that the solver's model has not. Wall frame,
// metres; pictures in pixels from the top left corner.
#pragma once

#include <optional>

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/hall.h"
#include "common/config/rig.h"
#include "common/wall/surface.h"

namespace aquarama::hall {

// Where a lens is, and what it does. Its frame: x right, y up, looking along -z.
struct LensTruth {
    glm::dvec3 position{};
    glm::dmat3 wallFromLens{1.0};
    glm::dvec2 focal{1}, principal{}, size{};  // pixels
    config::HallLens lens = {};
    glm::dvec2 keystone{};  // of a projector's picture, as hall.proto has it
};

// Of a channel's projector in a hall, as the rig means it and as it hangs.
[[nodiscard]] LensTruth lensOf(const config::Channel& channel);
[[nodiscard]] LensTruth lensOf(const config::Channel& channel, const config::HallProjector& truth);
[[nodiscard]] LensTruth lensOf(const config::HallCamera& camera);
// The yaw, pitch and roll of a frame, in radians: the inverse of wall::turned().
[[nodiscard]] glm::dvec3 anglesOf(const glm::dmat3& wallFromFrame);

// Immutable. Exact to 1e-9 pixels, both ways.
class TrueLens {
  public:
    explicit TrueLens(const LensTruth& truth);

    // Continuous; a pixel outside of the picture has a ray too.
    [[nodiscard]] wall::Ray ray(glm::dvec2 pixel) const;
    // Nothing outside of the picture and behind the lens.
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const;
    // How much light a projector with this lens brings to a surface that faces it at a point, in
    // comparison with one metre straight ahead; with vignetting. For points that it lights.
    [[nodiscard]] double lightAt(glm::dvec3 point) const;
    // What vignetting leaves of a pixel's light.
    [[nodiscard]] double vignetted(glm::dvec2 pixel) const;
    [[nodiscard]] const LensTruth& truth() const { return truth_; }

  private:
    LensTruth truth_;
    double farthest_ = 0;  // of the tangents that reach the picture, squared
};

}  // namespace aquarama::hall
