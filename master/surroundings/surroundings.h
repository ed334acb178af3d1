// SPDX-License-Identifier: Apache-2.0
// The world that the fish live in: what they must not swim into, light and warmth, food, the
// submarine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "common/place/place.h"
#include "common/units/units.h"
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

// Where the school is drawn to, a function of seed and tick alone: a slow wandering path through
// what the wall shows, or the middle of a bait ball.

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
