// SPDX-License-Identifier: Apache-2.0
// How fish stand in the water at tick 0.
#pragma once

#include <cstdint>
#include <vector>

#include "common/motion/motion_state.h"
#include "master/surroundings/journey.h"
#include "master/surroundings/surroundings.h"
#include "master/world/world.h"

namespace aquarama::world {

[[nodiscard]] std::vector<motion::FishTraits> traitsOf(const WorldOptions& options);

// Where every fish is at tick 0, each at its own phase of the tail beat (else they beat as one): a
// member with a start about that; the school about its goal, heading along its way; the others each
// at a place of its own.
void placeFish(const WorldOptions& options,
               const surroundings::Goal& goal,
               const surroundings::Surroundings& surroundings,
               motion::MotionStates& states);

// One fish at a place, level and along `course`; its tail beats on.
void placeFishAt(motion::MotionStates& states, std::size_t fish, glm::vec3 place, glm::vec3 course);

}  // namespace aquarama::world
