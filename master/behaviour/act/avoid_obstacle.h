// SPDX-License-Identifier: Apache-2.0
// Turns away from sand, rock, plant, surface or submarine.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// Where the surroundings push, as a way round: what would only throw the fish back turns it to the
// side on which it gets past sooner.
[[nodiscard]] glm::vec3 wayRound(const Situation& situation);

// A member of a school keeps company meanwhile; others look to their way alone.
[[nodiscard]] fish::Course avoidObstacle(const Situation& situation, const fish::Mind& mind);

}  // namespace aquarama::behaviour
