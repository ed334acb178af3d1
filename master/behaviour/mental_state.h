// SPDX-License-Identifier: Apache-2.0
// Hunger, libido and fear (Tu & Terzopoulos 1994, section 6.1; Tu 1996, section 5.2), each 0 to 1.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// Hunger H = 1 - n_e R / alpha + a_h S_h, libido L = s (1 - H) + a_l S_l, fear F = sum of
// min(D0 / d, 1) over the predators in sight.
[[nodiscard]] fish::Feelings feel(const fish::SpeciesParameters& parameters,
                                  const fish::Mind& mind,
                                  const Senses& senses);

// What one fish draws for itself from the ranges of its species, by the seed.

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
