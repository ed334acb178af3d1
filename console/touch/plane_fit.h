// SPDX-License-Identifier: Apache-2.0
// The plane that a tracker watches, from three places of it that are known on the wall.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"

namespace aquarama::console {

// Where a mark is (wall frame, metres), and where the tracker saw who was at it (shares).
struct SeenMark {
    glm::dvec3 point{};
    glm::dvec2 share{};
};
using SeenMarks = std::array<SeenMark, 3>;

// Sets the three corners of a surface so that each mark is where it was seen: the one affine map.
// Throws Error, which says what to do, where the shares, or the marks, are too near or on one line.
void fitCorners(const SeenMarks& marks, config::TouchedSurface& surface);

// The farthest that a corner is off where somebody was a metre beside the mark, metres.
[[nodiscard]] double worstOfACorner(const SeenMarks& marks);

// One line that a person should know of a plane that was fitted.
struct PlaneFinding {
    std::string text;
    bool isDoubt = false;  // something was wrong when the marks were seen
};

// All of them; the size of the plane first.
[[nodiscard]] std::vector<PlaneFinding> findingsOf(const config::TouchedSurface& surface,
                                                   const SeenMarks& marks,
                                                   const glm::dvec3& eye);

}  // namespace aquarama::console
