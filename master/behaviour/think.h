// SPDX-License-Identifier: Apache-2.0
// One thought of one fish in four stages: perceive(), feel(), decide(), act(). Its feelings (Tu &
// Terzopoulos 1994, section 6.1; Tu 1996, section 5.2): hunger, libido and fear, each 0 to 1; and
// the temperament that a fish begins with.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

// Writes the mind and the course of this fish and appends its events; reads everything else. Fish
// with events of their own may think on several threads.
void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           DeferredEvents& events);

// Hunger H = 1 - n_e R / alpha + a_h S_h, libido L = s (1 - H) + a_l S_l, fear F = sum of min(D0 /
// d, 1) over the predators in sight; each limited to 1.
[[nodiscard]] fish::Feelings feel(const fish::SpeciesParameters& parameters,
                                  const fish::Mind& mind,
                                  const Senses& senses);

// Temperament: what a fish draws for itself, by the seed, from the ranges of its species.

// Bits of Like. A fish that would draw two that contradict each other has neither. The sex is not
// drawn: it follows from the length, in metres, or from the place in the order of the species.
[[nodiscard]] std::uint8_t likesOf(const fish::SpeciesParameters& parameters,
                                   std::uint32_t seed,
                                   std::uint32_t fish,
                                   float length);

// A mind as if the fish had lived long before: each with another time since its last meal and
// spawning, so that not all are hungry at once.
[[nodiscard]] fish::Mind freshMind(const fish::SpeciesParameters& parameters,
                                   std::uint32_t seed,
                                   std::uint32_t fish,
                                   float length);

}  // namespace aquarama::behaviour
