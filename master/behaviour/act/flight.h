// SPDX-License-Identifier: Apache-2.0
// Which way is away from the predators in sight.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// A unit vector, the nearer predator counting the more; none where none is seen. Before a predator
// that comes at it a fish goes aside rather than ahead, and so slips round behind it: that is how a
// school fountains about an attacker (Hall, Wardle & MacLennan 1986).
[[nodiscard]] glm::vec3 flightFrom(const Situation& situation);

}  // namespace aquarama::behaviour
