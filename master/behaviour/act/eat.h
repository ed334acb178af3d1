// SPDX-License-Identifier: Apache-2.0
// Goes for the particle of its intention and snaps at it: what is in a small cone before the mouth
// is drawn in with the water (Tu 1996, section 5.6.3).
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// Whether a thing is where the mouth's suction reaches; offset is from the body frame's origin,
// metres.
[[nodiscard]] bool isBeforeTheMouth(const Senses& senses, glm::vec3 offset);

[[nodiscard]] fish::Course eat(const Situation& situation,
                               fish::Mind& mind,
                               DeferredEvents& events);

}  // namespace aquarama::behaviour
