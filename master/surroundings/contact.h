// SPDX-License-Identifier: Apache-2.0
// The contact of a body with rocks and sand: what minds did not avoid in time does not go through.
#pragma once

#include <glm/vec3.hpp>

#include "master/surroundings/obstacles.h"

namespace aquarama::surroundings {

// The velocity, metres a second, at which the surface that is drawn pushes a body out whose middle
// is nearer to it than half its width: ten times the depth a second, 0.6 m/s at most; 0 clear of
// rocks and sand, and off the chart. World frame.
[[nodiscard]] glm::vec3 contactVelocity(const Obstacles& obstacles,
                                        glm::vec3 position,
                                        float halfWidthMetres);

}  // namespace aquarama::surroundings
