// SPDX-License-Identifier: Apache-2.0
// How fish stand in the water at tick 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/motion/motion_state.h"
#include "master/fish/fish_view.h"
#include "master/fish/secondary_controller.h"
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

// From a species' file to what its fish's minds use.

// Of cast[kind], whose fish are [first, last). Names that nobody of the cast bears are passed over.
[[nodiscard]] fish::SpeciesParameters makeSpeciesParameters(const std::vector<WorldSpecies>& cast,
                                                            std::size_t kind,
                                                            const fish::Gaits& gaits,
                                                            std::size_t first,
                                                            std::size_t last);

}  // namespace aquarama::world
