// SPDX-License-Identifier: Apache-2.0
// Whom a fish minds: its nearest visible schoolmates.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "master/behaviour/perceive/spatial_grid.h"
#include "master/fish/fish_view.h"

namespace aquarama {

// Real fish attend to about this many.
inline constexpr std::size_t kMostNeighbours = 7;
// Attraction ends at 5 body lengths (Huth & Wissel 1992): of the scad's 0.24 m.
inline constexpr float kSightMetres = 1.2F;
// About as wide as the seven nearest of a school are far; the search was quickest so.
inline constexpr float kCellMetres = 0.4F;

struct Neighbours {
    std::array<std::uint32_t, kMostNeighbours> fish{};
    std::array<float, kMostNeighbours> distanceSquared{};  // square metres, ascending
    std::size_t count = 0;
};

// The field of view is 300 degrees (Tu & Terzopoulos 1994): a fish is blind within 30 degrees of
// straight behind.
[[nodiscard]] bool inFieldOfView(glm::vec3 heading, glm::vec3 offset);

// The nearest visible within kSightMetres, nearest first; of equally near ones the lower index.
[[nodiscard]] Neighbours nearestVisible(const FishView& view,
                                        const SpatialGrid& grid,
                                        std::uint32_t fish);

}  // namespace aquarama
