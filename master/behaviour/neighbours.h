// SPDX-License-Identifier: Apache-2.0
// Whom a fish minds: its nearest visible schoolmates, and the nearest of the others.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "master/behaviour/grids.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

class Grids;

// Real fish attend to about this many.
inline constexpr std::size_t kMostNeighbours = 7;
// Attraction ends at 5 body lengths (Huth & Wissel 1992): of the scad's 0.24 m.
inline constexpr float kSightMetres = 1.2F;
// About as wide as the seven nearest of a school are far; the search was quickest so.
inline constexpr float kCellMetres = 0.48F;

struct Neighbours {
    std::array<std::uint32_t, kMostNeighbours> fish{};
    std::array<float, kMostNeighbours> distanceSquared{};  // square metres, ascending
    std::size_t count = 0;

    // Keeps the nearest; of equally near ones the lower index comes first.
    void insert(std::uint32_t other, float squared);
};

struct NearestFish {
    Neighbours schoolmates;  // of its own kind
    Neighbours others;       // of any other
};

// The field of view is 300 degrees (Tu & Terzopoulos 1994): a fish is blind within 30 degrees of
// straight behind.
inline constexpr float kBlindCosineSquared = 0.75F;  // cos^2 of 30 degrees
[[nodiscard]] bool inFieldOfView(glm::vec3 heading, glm::vec3 offset);

// Of each, the nearest visible within kSightMetres, nearest first; of equally near ones the lower
// index. `parameters` are those of its species.
[[nodiscard]] NearestFish nearestVisible(const fish::FishView& view,
                                         const Grids& grids,
                                         const fish::SpeciesParameters& parameters,
                                         std::uint32_t fish);
// The same bits by plain code.
[[nodiscard]] NearestFish nearestVisibleReference(const fish::FishView& view,
                                                  const SpatialGrid& grid,
                                                  const fish::SpeciesParameters& parameters,
                                                  std::uint32_t fish);

// How many fish nearestVisible() looks at together on this processor.
[[nodiscard]] std::size_t nearestVisibleLanes();

}  // namespace aquarama::behaviour
