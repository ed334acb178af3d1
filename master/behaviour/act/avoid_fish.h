// SPDX-License-Identifier: Apache-2.0
// Slows, or turns away from the fish that is in its sensitivity box, by where that one is and where
// it heads (Tu 1996, section 5.6.1).
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

[[nodiscard]] fish::Course avoidFish(const Situation& situation, const fish::Mind& mind);

}  // namespace aquarama::behaviour
