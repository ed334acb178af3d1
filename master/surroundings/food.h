// SPDX-License-Identifier: Apache-2.0
// What drifts in the water to be eaten: plankton, and pellets that visitors drop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "common/units/ids.h"

namespace aquarama {

enum class FoodKind : std::uint8_t { None, Plankton, Pellet };

// Structure of arrays, one element a particle; its index is its name for as long as it is there.
struct Food {
    std::vector<float> x, y, z;              // metres
    std::vector<FoodKind> kind;              // None: eaten, or not yet come
    std::vector<std::uint8_t> generation;    // counts up when another takes the place
    std::vector<std::uint32_t> absentUntil;  // tick, low 32 bits

    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] bool isThere(std::size_t i) const { return kind[i] != FoodKind::None; }
};

inline constexpr std::size_t kMostPellets = 256;  // in the water at a time

// Plankton strewn through the water, and room for pellets.
[[nodiscard]] Food makeFood(std::uint32_t seed, const Region& water, std::uint32_t plankton);
// One tick of drifting and sinking; what was eaten drifts in again after a while.
void driftFood(Food& food, std::uint32_t seed, const Region& water, Tick tick);
// Pellets about a point, while there is room.
void dropPellets(
    Food& food, std::uint32_t seed, glm::vec3 position, std::uint32_t pellets, Tick tick);
// False where it was gone already.
bool eatFood(Food& food, std::uint32_t particle, Tick tick);

}  // namespace aquarama
