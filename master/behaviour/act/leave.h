// SPDX-License-Identifier: Apache-2.0
// Leaves for water whose light and warmth suit its habits (Tu 1996, section 5.6): in our sea both
// change with height alone, so it climbs or dives.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// The nearest height (y, negative) within the water at which light and warmth suit the species, or
// where they do least ill.
[[nodiscard]] float suitableHeight(const Situation& situation);

[[nodiscard]] fish::Course leave(const Situation& situation);

}  // namespace aquarama::behaviour
