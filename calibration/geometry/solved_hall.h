// SPDX-License-Identifier: Apache-2.0
// The result of the solve: maps pixels of cameras and channels to points of the screen.
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

// A camera or a projector.
struct Device {
    LensParameters lens{};
    PoseParameters pose{};
};

// Immutable once it is solved; then for any thread. Refers to the screen of `wall`.
class SolvedHall {
  public:
    SolvedHall(const config::Rig& rig, const wall::Wall& wall, glm::ivec2 displacementCells);

    // The place that a channel's pixel lights; nothing where the light misses the screen.
    [[nodiscard]] std::optional<BumpyScreen::Place> placeOf(std::size_t channel,
                                                            glm::dvec2 pixel) const;
    // The place that a camera's pixel sees; nothing beside the screen.
    [[nodiscard]] std::optional<BumpyScreen::Place> placeSeen(std::size_t camera,
                                                              glm::dvec2 pixel) const;
    // The pixel of the tie's channel that the model gives for the tie's camera pixel.
    [[nodiscard]] std::optional<glm::dvec2> modelled(const Tie& tie) const;
    // The pixel of the panorama where a viewer at the sweet spot sees a point.
    [[nodiscard]] glm::dvec2 panoramaPixel(glm::dvec3 point) const;

    const config::Rig& rig;
    const wall::Wall& nominal;
    std::vector<Device> cameras, projectors;
    // The smooth difference between the model and the measured places, over the picture of each
    // projector, such as lens errors that the model lacks. Pixels, across and down.
    std::vector<FieldPair> corrections;
    BumpyScreen screen;
};

}  // namespace aquarama::geometry
