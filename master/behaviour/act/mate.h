// SPDX-License-Identifier: Apache-2.0
// Mating (Tu 1996, section 5.6.6): a fish follows one that courts nobody, shows itself to one that
// courts another, and with one that courts it goes through a courtship. Each has its time; then the
// fish gives up.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

[[nodiscard]] fish::Course mate(const Situation& situation,
                                fish::Mind& mind,
                                DeferredEvents& events);

}  // namespace aquarama::behaviour
