// SPDX-License-Identifier: Apache-2.0
// How a school stands in the water at tick 0.
#pragma once

#include <cstdint>
#include <vector>

#include "common/motion/motion_state.h"
#include "common/place/place.h"
#include "master/behaviour/journey.h"
#include "master/world/world.h"

namespace aquarama {

[[nodiscard]] std::vector<FishTraits> traitsOf(const WorldOptions& options);

// The first so many fish, loosely spaced about the goal, heading along its way, each at its own
// phase of the tail beat (else they beat as one).
void placeSchool(std::uint32_t seed,
                 const Goal& goal,
                 const Region& water,
                 float spacingMetres,
                 std::size_t fish,
                 MotionStates& states);

// The fish from `first` on, each at a place of its own.
void placeWanderers(std::uint32_t seed,
                    const Region& water,
                    std::size_t first,
                    MotionStates& states);

}  // namespace aquarama
