// SPDX-License-Identifier: Apache-2.0
// Where the school is drawn to, a function of seed and tick alone: a slow wandering path through
// what the wall shows, or the middle of a bait ball.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "common/units/ids.h"

namespace aquarama::surroundings {

struct Goal {
    glm::vec3 position{};                 // metres
    glm::vec3 velocityMetresPerSecond{};  // of the goal itself
    float mill = 0;      // 1: circle the goal, left about; -1: right about; 0: follow it
    float flatness = 1;  // the school's height per its breadth
};

[[nodiscard]] Goal journeyGoal(std::uint32_t seed, Tick tick);

// A bait ball: the middle of the water, which rises and sinks by a metre in 20 s.
[[nodiscard]] Goal millGoal(std::uint32_t seed,
                            const place::Region& water,
                            float radius,
                            Tick tick);
// How far out a ball of so many fish of a mean length reaches at ease; broader than high where the
// water is shallow.
[[nodiscard]] float millRadiusMetres(const place::Region& water,
                                     std::size_t fish,
                                     float lengthMetres);

}  // namespace aquarama::surroundings
