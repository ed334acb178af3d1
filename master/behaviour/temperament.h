// SPDX-License-Identifier: Apache-2.0
// What one fish draws for itself from the ranges of its species, by the seed.
#pragma once

#include <cstdint>

#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::behaviour {

// Bits of Like. Of two that contradict each other a fish that would draw both has neither.
[[nodiscard]] std::uint8_t likesOf(const fish::SpeciesParameters& parameters,
                                   std::uint32_t seed,
                                   std::uint32_t fish);

// A mind at tick 0, as if it had lived long before: fed and in love by a share of its own, so that
// not all hunger at once.
[[nodiscard]] fish::Mind freshMind(const fish::SpeciesParameters& parameters,
                                   std::uint32_t seed,
                                   std::uint32_t fish);

}  // namespace aquarama::behaviour
