// SPDX-License-Identifier: Apache-2.0
// The contact of a body with rocks, sand and the border of its water: what minds did not avoid in
// time does not go through.
#pragma once

#include <glm/vec3.hpp>

#include "common/place/obstacles.h"

namespace aquarama::place {

// The velocity, metres a second, world frame, of a body by contact; 0 clear of all. The surface
// that is drawn pushes it out where its middle is nearer than half its width and 1 cm: forty times
// the depth a second, 2 m/s at most. Beyond 0.3 m out of the water the current does not carry it
// off for ever: it drifts back at half the way a second, 0.1 m/s at most.
[[nodiscard]] glm::vec3 contactVelocity(const Obstacles& obstacles,
                                        glm::vec3 position,
                                        float halfWidthMetres);

}  // namespace aquarama::place
