// SPDX-License-Identifier: Apache-2.0
// Who and what is where: all fish in a fine grid; predators, large bodies, willing mates and food
// in sparse grids of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/place/place.h"
#include "master/behaviour/perceive/spatial_grid.h"
#include "master/fish/fish_view.h"
#include "master/fish/nature.h"
#include "master/surroundings/food.h"

namespace aquarama {

inline constexpr float kLargeBodyMetres = 0.6F;  // from this length a fish is a large body

class Grids {
  public:
    Grids(const Region& water, std::size_t fish, std::size_t food);
    // Of those that are there. Allocates nothing.
    void rebuild(const FishView& view, const Food& food, std::span<const Nature> natures);
    [[nodiscard]] std::size_t bytes() const;

    SpatialGrid fish;
    SpatialGrid predators;
    SpatialGrid large;
    SpatialGrid mates;
    SpatialGrid food;

  private:
    std::vector<std::uint32_t> chosen_;
};

}  // namespace aquarama
