// SPDX-License-Identifier: Apache-2.0
// Cleaners and their clients: who is with whom at a station, which is the home of a cleaner. Not
// seen by rays: clients know the stations about them.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// Only a fish that is longer, metres, and not prey goes to a cleaner.
inline constexpr float kLeastClientMetres = 0.12F;
// At a station no more than so many fish are clients at a time.
inline constexpr std::size_t kMostClients = 3;

// Whether a fish of a species, so long in metres, goes to cleaners.
[[nodiscard]] bool goesToCleaners(const fish::SpeciesParameters& parameters, float lengthMetres);

// Writes urge, cleaner, clients, posing and bitten of a client, or client of a cleaner. Length and
// position must be sensed already.
void senseCleaning(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   const fish::Mind& mind,
                   Senses& senses);

}  // namespace aquarama::behaviour
