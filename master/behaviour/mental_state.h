// SPDX-License-Identifier: Apache-2.0
// Hunger, libido and fear (Tu & Terzopoulos 1994, section 6.1; Tu 1996, section 5.2), each 0 to 1.
#pragma once

#include "master/behaviour/perceive/senses.h"
#include "master/fish/drives.h"
#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::behaviour {

// Hunger H = 1 - n_e R / alpha + a_h S_h, libido L = s (1 - H) + a_l S_l, fear F = sum of
// min(D0 / d, 1) over the predators in sight.
[[nodiscard]] fish::Feelings feel(const fish::SpeciesParameters& parameters,
                                  const fish::Mind& mind,
                                  const Senses& senses);

}  // namespace aquarama::behaviour
