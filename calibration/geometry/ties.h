// SPDX-License-Identifier: Apache-2.0
// Ties: the measurements in a camera's view that the solver uses. They are places that the camera
// and a channel share, and places of the screen's outline and of marks on it.
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

// A place of a camera's picture and the place of a channel's picture that lights it, from a smooth
// surface through a small window of pixels.
struct Tie {
    std::uint32_t camera = 0, channel = 0;
    glm::dvec2 seen{};         // in the camera's picture
    glm::dvec2 place{};        // in the channel's picture
    double sigma = 0;          // standard deviation of the place, pixels of the channel
    bool heldOut = false;      // kept from the solver, to measure its error
    std::uint32_t window = 0;  // the same number for all channels that are seen at this place
};

// The ties of a view. One window in five is held out, the same one for all channels. The screen is
// divided into about `most` windows.
[[nodiscard]] std::vector<Tie> tiesOf(const scan::CameraView& view,
                                      std::uint32_t camera,
                                      std::size_t most);

// A point of the screen's outline and its place in the camera's picture.
struct OutlineTie {
    std::uint32_t camera = 0;
    glm::dvec2 unrolled{};  // the point, at the edge of the rig's screen
    glm::dvec3 base{}, baseNormal{};
    glm::dvec2 seen{};    // in the camera's picture
    glm::dvec2 across{};  // the direction across the outline there, length one
};

// Finds the screen's edge within `reach` pixels of the outline that lens and pose predict.
[[nodiscard]] std::vector<OutlineTie> outlineTies(const Light& room,
                                                  std::uint32_t camera,
                                                  const BumpyScreen& screen,
                                                  const LensParameters& lens,
                                                  const PoseParameters& pose,
                                                  double reach);

// A strip of tape that marks the middle of an edge of the screen.
struct MarkTie {
    OutlineTie tie;    // a point in the strip; across the strip
    double sigma = 0;  // how exactly crews place tape: standard deviation, pixels of the camera
};

// Finds dark strips as wide as tape near the places of wall::markPlaces, in the picture of the lit
// room. Strips that are missing or have another width are left out.
[[nodiscard]] std::vector<MarkTie> markTies(const Light& room,
                                            std::uint32_t camera,
                                            config::ScreenShape shape,
                                            const BumpyScreen& screen,
                                            const LensParameters& lens,
                                            const PoseParameters& pose);

}  // namespace aquarama::geometry
