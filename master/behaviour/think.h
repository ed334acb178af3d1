// SPDX-License-Identifier: Apache-2.0
// One thought of one fish: perceive, feel, decide, act. Four stages, each a folder.
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

// Writes the fish's own mind and course, and adds to the events; nothing else changes.
void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           DeferredEvents& events);

}  // namespace aquarama::behaviour
