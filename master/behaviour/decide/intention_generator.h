// SPDX-License-Identifier: Apache-2.0
// The intention generator (Tu & Terzopoulos 1994, section 6.2): collision first, then fear, then
// what was interrupted, then hunger and libido by strength, then habits.
#pragma once

#include "master/behaviour/feel/mental_state.h"
#include "master/behaviour/perceive/senses.h"
#include "master/fish/minds.h"
#include "master/fish/nature.h"

namespace aquarama {

struct Decision {
    Intention intention = Intention::Wander;
    std::uint32_t target = kNobody;
};

[[nodiscard]] Decision decide(const Nature& nature,
                              const Mind& mind,
                              const Senses& senses,
                              const Feelings& feelings);

// The mind with the decision taken: what it interrupts is remembered, what it resumes forgotten.
void remember(Mind& mind, const Decision& decision);

}  // namespace aquarama
