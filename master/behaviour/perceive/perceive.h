// SPDX-License-Identifier: Apache-2.0
// The first stage of a thought: from the environment to what one fish perceives of it.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive/environment.h"
#include "master/behaviour/perceive/senses.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// `mind` says whom it is attending to, so that a target is kept unless another is better by its
// persistence.
[[nodiscard]] Senses perceive(const Environment& environment,
                              const fish::SpeciesParameters& parameters,
                              std::uint32_t fish,
                              const fish::Mind& mind);

}  // namespace aquarama::behaviour
