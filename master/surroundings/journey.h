// SPDX-License-Identifier: Apache-2.0
// Where the school is drawn to: a slow wandering path through what the wall shows, a function of
// seed and tick alone.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "common/units/ids.h"

namespace aquarama {

struct Goal {
    glm::vec3 position{};                 // metres
    glm::vec3 velocityMetresPerSecond{};  // of the goal itself
    float mill = 0;  // 1: circle the goal, left about; -1: right about; 0: follow it
};

[[nodiscard]] Goal journeyGoal(std::uint32_t seed, Tick tick);

}  // namespace aquarama
