// SPDX-License-Identifier: Apache-2.0
// What the solver takes of a camera's view: places that the camera and a channel share, and where
// the camera sees the outline of the screen and marks on it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "calibration/geometry/model.h"
#include "calibration/scan/decode.h"
#include "common/wall/mark.h"

namespace aquarama::geometry {

// A place of a camera's picture and the place of a channel's picture that lights it: the value of a
// smooth surface through a small window of pixels.
struct Tie {
    std::uint32_t camera = 0, channel = 0;
    glm::dvec2 seen{};         // in the camera's picture
    glm::dvec2 place{};        // in the channel's picture
    double sigma = 0;          // standard deviation of the place, pixels of the channel
    bool heldOut = false;      // not shown to the solver: the error is measured there
    std::uint32_t window = 0;  // the same for all channels that are seen at a place
};

// One window in five is held out, the same for all channels. About `most` windows hold the screen.
[[nodiscard]] std::vector<Tie> tiesOf(const scan::CameraView& view,
                                      std::uint32_t camera,
                                      std::size_t most);

// A point of the screen's outline, and where the camera sees it.
struct OutlineTie {
    std::uint32_t camera = 0;
    glm::dvec2 unrolled{};  // the point, at the edge of the rig's screen
    glm::dvec3 base{}, baseNormal{};
    glm::dvec2 seen{};    // in the camera's picture
    glm::dvec2 across{};  // of the outline there, length one
};

// Looks for the screen's edge along the outline that lens and pose predict, up to `reach` pixels to
// both sides.
[[nodiscard]] std::vector<OutlineTie> outlineTies(const Light& room,
                                                  std::uint32_t camera,
                                                  const BumpyScreen& screen,
                                                  const LensParameters& lens,
                                                  const PoseParameters& pose,
                                                  double reach);

// A strip of tape that marks the middle of an edge.
struct MarkTie {
    OutlineTie tie;    // a point in the strip; across the strip
    double sigma = 0;  // standard deviation, pixels of the camera: of how well crews stick tape
};

// Looks in the room's light for dark strips as wide as tape about where they belong
// (wall::markPlaces). What is not there, or not as wide, is left out.
[[nodiscard]] std::vector<MarkTie> markTies(const Light& room,
                                            std::uint32_t camera,
                                            config::ScreenShape shape,
                                            const BumpyScreen& screen,
                                            const LensParameters& lens,
                                            const PoseParameters& pose);

}  // namespace aquarama::geometry
