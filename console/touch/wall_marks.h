// SPDX-License-Identifier: Apache-2.0
// Three marks that a crew finds on the wall by its grid, without a tape measure.
#pragma once

#include <array>
#include <string>

#include <glm/vec3.hpp>

#include "common/config/rig.h"

namespace aquarama::console {

// Where somebody holds a hand, or stands.
struct WallMark {
    glm::dvec3 point{};  // wall frame, metres
    std::string words;   // what to do, and where it is: directions from the middle, lines to count
};
using WallMarks = std::array<WallMark, 3>;

// Crossings of the grid that a channel lights, within reach of a hand where there are some: two of
// one height far apart, and a third below the first. They lie within so much of the panorama's
// width and height, about its middle. Throws Error where there are none.
[[nodiscard]] WallMarks marksForHands(const config::Rig& rig, double share);

// On the floor: before the wall under two upright lines of the grid, and at the sweet spot.
[[nodiscard]] WallMarks marksForPeople(const config::Rig& rig, double share);

}  // namespace aquarama::console
