// SPDX-License-Identifier: Apache-2.0
// Chasing a target (Tu 1996, section 5.6.2; paper, section 5.2): a general direction from far off,
// the exact one when near, and slower then.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

// towards: from the body to the target, metres; speed in body lengths a second when far; velocity
// of the target in metres a second: a moving one is met where it will be.
[[nodiscard]] fish::Course pursue(const Situation& situation,
                                  glm::vec3 towards,
                                  float speed,
                                  glm::vec3 velocity = {});

// The course along the desired direction (any length), bent by what pushes.
[[nodiscard]] fish::Course heading(const Situation& situation, glm::vec3 desired, float speed);

// Away from the predators in sight: a unit vector, the nearer predator counting the more; none
// where none is seen. Before a predator that comes at it a fish goes aside rather than ahead, and
// so slips round behind it: that is how a school fountains about an attacker (Hall, Wardle &
// MacLennan 1986).
[[nodiscard]] glm::vec3 flightFrom(const Situation& situation);

}  // namespace aquarama::behaviour
