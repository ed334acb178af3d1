// SPDX-License-Identifier: Apache-2.0
// The intention generator's word on what the secondary controller recommends (paper, section 5.1).
#pragma once

#include "master/behaviour/mental_state.h"
#include "master/behaviour/perceive/senses.h"
#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::behaviour {

// Whether a fish with this intention may swim another pattern for a while, for no reason but
// variety. Not while a stroke counts: in flight, in fear, in another's way, near what it eats, in
// courtship.
[[nodiscard]] bool acceptsRecommendation(const fish::SpeciesParameters& parameters,
                                         const fish::Mind& mind,
                                         const Senses& senses,
                                         const fish::Feelings& feelings);

}  // namespace aquarama::behaviour
