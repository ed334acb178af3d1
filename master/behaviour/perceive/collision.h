// SPDX-License-Identifier: Apache-2.0
// Which fish is about to be in the way (Tu 1996, section 5.4): the one most of whose middle line
// lies in the box about this fish to which it is sensitive.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive/environment.h"
#include "master/behaviour/perceive/senses.h"
#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::behaviour {

// About the origin of a body frame: ahead (x), above and below (y), aside (z); metres.
struct Box {
    float ahead = 0, behind = 0, up = 0, aside = 0;
};

// The share of the straight line from `nose` to `tail`, in the frame of the box, that is inside.
[[nodiscard]] float shareInside(const Box& box, glm::vec3 nose, glm::vec3 tail);

// Writes Senses::collision and collisionShare, from the neighbours already in `senses` and from
// large bodies.
void feelCollision(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   const fish::Mind& mind,
                   Senses& senses);

}  // namespace aquarama::behaviour
