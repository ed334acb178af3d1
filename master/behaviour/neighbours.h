// SPDX-License-Identifier: Apache-2.0
// Neighbours: the nearest visible fish of the same species, and the nearest of other species.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "master/behaviour/grids.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

class Grids;

// Number of neighbours that a fish attends to, as real fish do.
inline constexpr std::size_t kMostNeighbours = 7;
// Neighbours are sought this far: 5 body lengths (Huth & Wissel 1992) of a scad of 0.24 m.
inline constexpr float kSightMetres = 1.2F;
// Width of a cell of the fish grid: about the distance of the seventh neighbour in a school. The
// search was measured to be fastest so.
inline constexpr float kCellMetres = 0.48F;

// The nearest fish found, in order.
struct Neighbours {
    std::array<std::uint32_t, kMostNeighbours> fish{};
    std::array<float, kMostNeighbours> distanceSquared{};  // square metres, ascending
    std::size_t count = 0;

    // Inserts a fish if it is among the nearest; of equally near ones the lower index comes first.
    void insert(std::uint32_t other, float squared);
};

// The result of the search for one fish.
struct NearestFish {
    Neighbours schoolmates;  // of its own kind
    Neighbours others;       // of any other
};

// The field of view is 300 degrees (Tu & Terzopoulos 1994): nothing within 30 degrees of straight
// behind is visible. `heading` is a unit vector; `offset` leads to the object.
inline constexpr float kBlindCosineSquared = 0.75F;  // cos^2 of 30 degrees
[[nodiscard]] bool inFieldOfView(glm::vec3 heading, glm::vec3 offset);

// For both, the nearest visible fish within kSightMetres, nearest first; of equally near ones the
// lower index. `parameters` are those of the species of `fish`. Vectorised; any thread.
[[nodiscard]] NearestFish nearestVisible(const fish::FishView& view,
                                         const Grids& grids,
                                         const fish::SpeciesParameters& parameters,
                                         std::uint32_t fish);
// The same result, bit for bit, by plain code; the reference for tests.
[[nodiscard]] NearestFish nearestVisibleReference(const fish::FishView& view,
                                                  const SpatialGrid& grid,
                                                  const fish::SpeciesParameters& parameters,
                                                  std::uint32_t fish);

// Number of lanes of the vectors of nearestVisible() on this processor.
[[nodiscard]] std::size_t nearestVisibleLanes();

}  // namespace aquarama::behaviour
