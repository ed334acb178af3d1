// SPDX-License-Identifier: Apache-2.0
// Pursuit of a target (Tu 1996, section 5.6.2; paper, section 5.2): a rough direction from far off,
// the exact one and a lower speed when near. Also flight from predators.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

// A course to a target. `towards` leads from the body to the target, metres; `speed` is that from
// far off, body lengths a second; `velocity` is that of the target, metres a second: a moving
// target is met where it will be.
[[nodiscard]] fish::Course pursue(const Situation& situation,
                                  glm::vec3 towards,
                                  float speed,
                                  glm::vec3 velocity = {});

// A course along the desired direction (any length), bent by obstacles, no steeper than 25 degrees.
[[nodiscard]] fish::Course heading(const Situation& situation, glm::vec3 desired, float speed);

// Direction of flight from the predators in sight, a unit vector; zero where there is none. Nearer
// predators count more. A fish before an approaching predator goes aside rather than ahead and so
// slips round behind it: the fountain manoeuvre of a school (Hall, Wardle & MacLennan 1986).
[[nodiscard]] glm::vec3 flightFrom(const Situation& situation);

}  // namespace aquarama::behaviour
