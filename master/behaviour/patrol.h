// SPDX-License-Identifier: Apache-2.0
// The patrol of a predator without a home: ovals along the border of its water, off the reef by
// day, along it at dusk and by night.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"

namespace aquarama::behaviour {

// The next point of its way, metres, world frame: 40 degrees ahead on the oval of its present
// stretch of the border, or on the way there along the border.
[[nodiscard]] glm::vec3 patrolGoal(const Environment& environment,
                                   std::uint32_t fish,
                                   glm::vec3 position);

}  // namespace aquarama::behaviour
