// SPDX-License-Identifier: Apache-2.0
// What reaches the world from outside: the only things beside seed and scene that change it, and
// so all that a recording must hold.
#pragma once

#include <cstdint>
#include <variant>

#include <glm/vec3.hpp>

#include "common/units/steering.h"

namespace aquarama::world {

// A visitor feeds the fish.
struct DropFood {
    glm::vec3 position{};  // metres, world frame
    std::uint32_t pellets = 12;
};

// Puts the submarine somewhere else: on a stage, not by hand (that is a Steering).
struct MoveSubmarine {
    glm::vec3 position{};
    glm::vec3 velocityMetresPerSecond{};
};

using WorldInput = std::variant<DropFood, MoveSubmarine, Steering>;

}  // namespace aquarama::world
