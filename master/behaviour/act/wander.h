// SPDX-License-Identifier: Apache-2.0
// Goes about as its species does at ease (Habits): its paces, its home, its partner, its turns for
// no reason.
#pragma once

#include <cstdint>

#include "common/units/ids.h"
#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// Body lengths a second, by the shares of Habits::paces; another every five seconds.
[[nodiscard]] float paceOf(const fish::SpeciesParameters& parameters,
                           std::uint32_t seed,
                           std::uint32_t fish,
                           Tick tick);

[[nodiscard]] fish::Course wander(const Situation& situation);

}  // namespace aquarama::behaviour
