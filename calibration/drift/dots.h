// SPDX-License-Identifier: Apache-2.0
// Finds the dots that the channels of a wall show in a camera's pictures.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/scan/pictures.h"
#include "common/config/rig.h"

namespace aquarama::drift {

// One dot in a camera's picture, and the channel that shows it.
struct SeenDot {
    std::size_t channel = 0;
    int dot = 0;         // its index in the picture: wall::scanDotPlace()
    glm::dvec2 place{};  // camera pixels from the top left corner
    double radius = 0;   // about, camera pixels
};

// From the pictures of scan::dotSequenceOf(rig, true): each dot that is seen and whose number is
// read.
[[nodiscard]] std::vector<SeenDot> numberedDots(scan::PictureSource& source,
                                                const config::Rig& rig);

// From the pictures of scan::dotSequenceOf(rig, false): where the earlier dots are now. Dots that
// are not found, or moved by more than a third of the distance to the next dot, are left out.
[[nodiscard]] std::vector<SeenDot> foundAgain(scan::PictureSource& source,
                                              const std::vector<SeenDot>& before);

}  // namespace aquarama::drift
