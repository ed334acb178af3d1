// SPDX-License-Identifier: Apache-2.0
// Turns away from sand, rock, plant, surface or submarine.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama {

[[nodiscard]] Course avoidObstacle(const Situation& situation);

}  // namespace aquarama
