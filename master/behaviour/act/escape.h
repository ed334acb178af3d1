// SPDX-License-Identifier: Apache-2.0
// Flees from all predators in sight, the nearer the more, as fast as it can, out of the way of all
// who flee beside it (Tu 1996, section 5.6.4). A fish of a school leaves it only as the predator
// comes near, so that a hollow opens about the attacker and closes behind it.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

[[nodiscard]] fish::Course escape(const Situation& situation, const fish::Mind& mind);

}  // namespace aquarama::behaviour
