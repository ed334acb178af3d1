// SPDX-License-Identifier: Apache-2.0
// Fish that keep to themselves: each goes from place to place of its own, in no hurry, round what
// is in its way.
#pragma once

#include <cstdint>

#include "common/units/ids.h"
#include "master/behaviour/neighbour_grid.h"
#include "master/behaviour/school_view.h"
#include "master/behaviour/steering.h"
#include "master/behaviour/surroundings.h"

namespace aquarama {

// Where a fish is bound for, in the water where the wall sees it. Another place every quarter of a
// minute.
[[nodiscard]] glm::vec3 wanderingGoal(std::uint32_t seed,
                                      const Region& water,
                                      std::size_t fish,
                                      Tick tick);

// Forms the intentions of those among fish [first, last) that think at this tick.
struct Wandering {
    const SchoolView* view = nullptr;
    const NeighbourGrid* grid = nullptr;
    const Surroundings* surroundings = nullptr;
    float cruise = 1;  // body lengths a second
    std::uint32_t seed = 0;
    Tick tick;
    Intentions* intentions = nullptr;

    void run(std::size_t first, std::size_t last) const;

  private:
    void think(std::size_t fish) const;
};

}  // namespace aquarama
