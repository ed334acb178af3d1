// SPDX-License-Identifier: Apache-2.0
// A predator's meal (Tu 1996, section 5.6.5): it goes slowly for its prey, rushes at it from near,
// and snaps when it is at the mouth. Prey that turns more sharply gets away.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// Of Mind::stage while a predator is about a prey.
enum class HuntStage : std::uint8_t { Stalk, Rush };

[[nodiscard]] fish::Course hunt(const Situation& situation,
                                fish::Mind& mind,
                                DeferredEvents& events);

}  // namespace aquarama::behaviour
