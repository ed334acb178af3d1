// SPDX-License-Identifier: Apache-2.0
// From a fish's mind to what others see of its mood.
#pragma once

#include <cstdint>

#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::fish {

// Writes all signs of a fish but kAway, which is kept, and whom it courts.
void showMood(const SpeciesParameters& parameters,
              const Minds& minds,
              std::uint32_t fish,
              FishView& view);

}  // namespace aquarama::fish
