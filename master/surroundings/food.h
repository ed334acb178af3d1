// SPDX-License-Identifier: Apache-2.0
// What drifts in the water to be eaten: plankton, and pellets that visitors drop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/units.h"
#include "master/surroundings/obstacles.h"

namespace aquarama::surroundings {

enum class FoodKind : std::uint8_t { None, Plankton, Pellet };

// Structure of arrays, one element a particle; its index is its name for as long as it is there.
struct Food {
    std::vector<float> x, y, z;              // metres
    std::vector<float> lowest;               // height under which it does not sink, metres
    std::vector<FoodKind> kind;              // None: eaten, or not yet come
    std::vector<std::uint8_t> taken;         // 1: on its way into a mouth
    std::vector<std::uint8_t> generation;    // counts up when another takes the place
    std::vector<std::uint32_t> absentUntil;  // tick, low 32 bits; of a pellet when it dissolves
    std::uint32_t pellets = 0;               // in the water

    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] bool isThere(std::size_t i) const { return kind[i] != FoodKind::None; }
    // A fish may go for it: nobody has it, and it is not so near to the sand that a fish would
    // turn back before.
    [[nodiscard]] bool isFree(std::size_t i) const {
        return isThere(i) && taken[i] == 0 &&
               (kind[i] == FoodKind::Plankton || y[i] > lowest[i] + kOutOfReachMetres);
    }
    static constexpr float kOutOfReachMetres = 0.4F;  // of a pellet over the sand
};

inline constexpr std::size_t kMostPellets = 256;  // in the water at a time

// Plankton strewn through the water where fish can reach it, and room for pellets.
[[nodiscard]] Food makeFood(std::uint32_t seed, const Obstacles& obstacles, std::uint32_t plankton);
// One tick of drifting and sinking; what was eaten drifts in again elsewhere after a while.
void driftFood(Food& food, std::uint32_t seed, const Obstacles& obstacles, Tick tick);
// Pellets about a point, while there is room. They sink, lie on the sand for a while and dissolve.
void dropPellets(Food& food,
                 std::uint32_t seed,
                 const Obstacles& obstacles,
                 glm::vec3 position,
                 std::uint32_t pellets,
                 Tick tick);
// From now on nobody else can have it. False where somebody has, or it is gone.
bool takeFood(Food& food, std::uint32_t particle);
// It is swallowed.
void removeFood(Food& food, std::uint32_t particle, Tick tick);

// The water's own motion at a place, metres a second: a slow swell of the whole sea that dies away
// towards the borders. Exact arithmetic.
[[nodiscard]] glm::vec3 currentAt(const place::Region& water, glm::vec3 position, Tick tick);

}  // namespace aquarama::surroundings
