// SPDX-License-Identifier: Apache-2.0
// Whether light and temperature suit the habits of a fish, and where they would (Tu 1996, section
// 5.1).
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// Writes light, celsius, discomfort and betterUp for a fish with these habits (bits of Like).
void feelClimate(const surroundings::Surroundings& around,
                 const fish::SpeciesParameters& parameters,
                 std::uint8_t likes,
                 Senses& senses);

}  // namespace aquarama::behaviour
