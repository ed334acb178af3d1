// SPDX-License-Identifier: Apache-2.0
// The structures of a reef: places by which a school finds its way and at which it stays.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "common/place/obstacles.h"

namespace aquarama::surroundings {

// Boulders that stand together.
struct Structure {
    glm::vec3 crown{};  // the top of the highest, metres, world frame
    float radiusMetres = 1;
    // How much schools like it, 0.3 to 1; drawn by the seed, so that one place leads.
    float liking = 1;
    // What schools remember of it, 0 to 1: how tired they are of it, and how lately fish of a
    // school were frightened there. rememberPlaces() changes both (master/behaviour/ways.h).
    float tiredOf = 0, fright = 0;
};

// At most this many, the highest first.
inline constexpr std::size_t kMostStructures = 12;

// The structures that stand in the water, in plan; none in the open sea.
[[nodiscard]] std::vector<Structure> structuresOf(const place::Obstacles& obstacles);

}  // namespace aquarama::surroundings
