// SPDX-License-Identifier: Apache-2.0
// One thought of one fish: perceive, feel, decide, act. Four stages, each a folder.
#pragma once

#include <cstdint>

#include "master/behaviour/act/routines.h"
#include "master/behaviour/perceive/environment.h"
#include "master/fish/courses.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// Writes the fish's own mind and course, and adds to the events; nothing else changes.
void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           DeferredEvents& events);

}  // namespace aquarama::behaviour
