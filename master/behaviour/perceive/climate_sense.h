// SPDX-License-Identifier: Apache-2.0
// Whether light and warmth suit a fish's habits, and where they would (Tu 1996, section 5.1).
#pragma once

#include <cstdint>

#include "master/behaviour/perceive/senses.h"
#include "master/fish/species_parameters.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

// Writes light, celsius, discomfort and betterUp of a fish that has these habits (bits of Like).
void feelClimate(const surroundings::Surroundings& around,
                 const fish::SpeciesParameters& parameters,
                 std::uint8_t likes,
                 Senses& senses);

}  // namespace aquarama::behaviour
