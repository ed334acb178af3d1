// SPDX-License-Identifier: Apache-2.0
// One thought of one fish in four stages: perceive(), feel(), decide(), act().
#pragma once

#include <cstdint>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

// Writes the mind and the course of this fish and appends its events; reads everything else. Fish
// with events of their own may think on several threads.
void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           DeferredEvents& events);

}  // namespace aquarama::behaviour
