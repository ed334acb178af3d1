// SPDX-License-Identifier: Apache-2.0
// A solved hall: from pixels of cameras and channels to points of the screen.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "calibration/geometry/model.h"
#include "calibration/geometry/smooth_fit.h"
#include "calibration/geometry/ties.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama::geometry {

struct Device {
    LensParameters lens{};
    PoseParameters pose{};
};

// A solved hall: from pixels of cameras and channels to points of the screen. Immutable once
// solved; for any thread. Refers to the screen of `wall`.
class SolvedHall {
  public:
    SolvedHall(const config::Rig& rig, const wall::Wall& wall, glm::ivec2 displacementCells);

    // Nothing where the light passes the screen.
    [[nodiscard]] std::optional<BumpyScreen::Place> placeOf(std::size_t channel,
                                                            glm::dvec2 pixel) const;
    [[nodiscard]] std::optional<BumpyScreen::Place> placeSeen(std::size_t camera,
                                                              glm::dvec2 pixel) const;
    // What the model says of a place that a camera sees: a place in a channel's picture.
    [[nodiscard]] std::optional<glm::dvec2> modelled(const Tie& tie) const;
    // The place in the panorama, in its pixels, that a viewer at the sweet spot sees a point at.
    [[nodiscard]] glm::dvec2 panoramaPixel(glm::dvec3 point) const;

    const config::Rig& rig;
    const wall::Wall& nominal;
    std::vector<Device> cameras, projectors;
    // What is left between the model and the measured places of each projector, smooth over its
    // picture: lenses that the model does not know, and the like. Pixels, across and down.
    std::vector<FieldPair> corrections;
    BumpyScreen screen;
};

}  // namespace aquarama::geometry
