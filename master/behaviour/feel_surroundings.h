// SPDX-License-Identifier: Apache-2.0
// What a fish feels of what is around it: the push of rock, sand, the border of the water and the
// submarine.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// Writes push, urgency, hurry and submarineMetres of the senses. A fish feels what it would meet
// while it turns by a right angle. Reads its prey, which comes before.
void feelSurroundings(const Environment& environment,
                      const fish::SpeciesParameters& parameters,
                      std::uint32_t fish,
                      const fish::Mind& mind,
                      Senses& senses);

}  // namespace aquarama::behaviour
