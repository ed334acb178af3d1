// SPDX-License-Identifier: Apache-2.0
// The state of a world at tick 0: lengths and places of all fish, and the parameters of their
// species.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/motion/motion_state.h"
#include "master/fish/fish_view.h"
#include "master/fish/secondary_controller.h"
#include "master/surroundings/surroundings.h"
#include "master/world/world.h"

namespace aquarama::world {

// Id and length of every fish, in the order of the cast. Lengths are drawn from a bell curve within
// the range of the species.
[[nodiscard]] std::vector<motion::FishTraits> traitsOf(const WorldOptions& options);

// Places every fish at tick 0, at a phase of the tail beat of its own. A species with a Start is
// placed around it; the school around its goal, heading along the goal's way; every other fish at a
// place of its own. `states` has one element for each fish of the cast.
void placeFish(const WorldOptions& options,
               const surroundings::Goal& goal,
               std::span<const fish::SpeciesParameters> speciesParameters,
               const surroundings::Surroundings& surroundings,
               motion::MotionStates& states);

// Moves one fish to a place, level and heading along `course` (any length). Its tail beat goes on.
void placeFishAt(motion::MotionStates& states, std::size_t fish, glm::vec3 place, glm::vec3 course);

// Parameters of a species as minds use them: names become bits of the cast's indices.

// For cast[kind], whose fish are [first, last), with their homes in the surroundings. Names of
// species outside the cast are ignored.
[[nodiscard]] fish::SpeciesParameters makeSpeciesParameters(
    const std::vector<WorldSpecies>& cast,
    std::size_t kind,
    const fish::Gaits& gaits,
    const surroundings::Surroundings& surroundings,
    std::size_t first,
    std::size_t last);

}  // namespace aquarama::world
