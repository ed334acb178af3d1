// SPDX-License-Identifier: Apache-2.0
// The true lens of a projector or a camera, with terms that the solver's model lacks. Wall frame,
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

// The place and the optics of a lens. Its frame: x right, y up, looking along -z.
struct LensTruth {
    glm::dvec3 position{};
    glm::dmat3 wallFromLens{1.0};
    glm::dvec2 focal{1}, principal{}, size{};  // pixels
    config::HallLens lens = {};
    glm::dvec2 keystone{};  // of a projector's picture, as in hall.proto
};

// The lens of a channel's projector as the rig describes it, and as it hangs in a hall; of a
// camera.
[[nodiscard]] LensTruth lensOf(const config::Channel& channel);
[[nodiscard]] LensTruth lensOf(const config::Channel& channel, const config::HallProjector& truth);
[[nodiscard]] LensTruth lensOf(const config::HallCamera& camera);
// The yaw, pitch and roll of a frame, in radians: the inverse of wall::turned().
[[nodiscard]] glm::dvec3 anglesOf(const glm::dmat3& wallFromFrame);

// Immutable. Exact to 1e-9 pixels, both ways.
class TrueLens {
  public:
    explicit TrueLens(const LensTruth& truth);

    // The ray of a pixel (continuous); pixels outside the picture have one too.
    [[nodiscard]] wall::Ray ray(glm::dvec2 pixel) const;
    // The inverse; nothing outside the picture and behind the lens.
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const;
    // The light of a projector with this lens on a surface that faces it at a point that it lights,
    // relative to one metre straight ahead; with vignetting.
    [[nodiscard]] double lightAt(glm::dvec3 point) const;
    // The share of a pixel's light that vignetting leaves.
    [[nodiscard]] double vignetted(glm::dvec2 pixel) const;
    [[nodiscard]] const LensTruth& truth() const { return truth_; }

  private:
    LensTruth truth_;
    double farthest_ = 0;  // the greatest squared tangent whose image is in the picture
};

}  // namespace aquarama::hall
