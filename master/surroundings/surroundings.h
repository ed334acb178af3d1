// SPDX-License-Identifier: Apache-2.0
// The world that the fish live in: what they must not swim into, light and warmth, food, the
// submarine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "common/units/ids.h"
#include "master/surroundings/climate.h"
#include "master/surroundings/food.h"
#include "master/surroundings/obstacles.h"

namespace aquarama::surroundings {

struct Submarine {
    glm::vec3 position{};  // of the eye, metres
    glm::vec3 velocityMetresPerSecond{};
    float radiusMetres = 0.9F;  // no fish comes nearer: it would fill the wall
};

struct Surroundings {
    std::uint32_t seed = 0;
    Obstacles obstacles;
    Climate climate;
    Food food;
    Submarine submarine;
    float clarityMetres = 12;             // no fish sees farther
    float daylight = 1;                   // of this tick
    std::vector<config::FoodDrop> drops;  // of the scene, in their order
    std::size_t nextDrop = 0;
};

[[nodiscard]] Surroundings makeSurroundings(const config::Scene& scene,
                                            std::uint32_t seed,
                                            std::size_t fish,
                                            float meanLengthMetres);
// One tick of what goes on without the fish.
void advanceSurroundings(Surroundings& surroundings, Tick tick);
// The hash with all folded in that fish and visitors have changed.
[[nodiscard]] std::uint64_t foldedSurroundings(std::uint64_t hash,
                                               const Surroundings& surroundings);

}  // namespace aquarama::surroundings
