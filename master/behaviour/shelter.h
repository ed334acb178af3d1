// SPDX-License-Identifier: Apache-2.0
// Which shelter a fish dives into or rests in: the site of its species' kinds of least way.
#pragma once

#include "master/behaviour/onlooker.h"

namespace aquarama::behaviour {

// Writes Senses::shelter: the present shelter, or the one of least way; how many others dive;
// whether it ventures out. Reads its schoolmates, predators and hour, which come before.
void senseShelter(const Onlooker& onlooker);

}  // namespace aquarama::behaviour
