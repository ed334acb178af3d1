// SPDX-License-Identifier: Apache-2.0
// Territories: who holds one, whom its owner charges, and who is charged.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// After a charge an owner charges nobody for so long.
inline constexpr float kRefractorySeconds = 6;
// A shoal of more fish than this in a territory is borne.
inline constexpr std::uint32_t kMostCharged = 8;

// Whether a fish holds the water about its home: by the share of its species, drawn by the seed;
// of a species that grazes in shoals who is alone.
[[nodiscard]] bool holdsTerritory(const Environment& environment,
                                  const fish::SpeciesParameters& parameters,
                                  std::uint32_t fish);

// Writes holdsTerritory, intruder and charger. An owner charges the nearest intruder of 0.6 to 1.7
// of its length, until it has touched it, has gone 1 to 2 m past its border, or has lost it.
void senseTerritory(const Environment& environment,
                    const fish::SpeciesParameters& parameters,
                    std::uint32_t fish,
                    const fish::Mind& mind,
                    Senses& senses);

}  // namespace aquarama::behaviour
