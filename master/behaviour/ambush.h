// SPDX-License-Identifier: Apache-2.0
// Where a predator lies in wait for prey that comes near.
#pragma once

#include <optional>

#include "master/behaviour/routines.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

// The course of a fish at ease that hunts from ambush: to its post, and there it waits, level or
// head down. Nothing for other species, and where there is no post.
[[nodiscard]] std::optional<fish::Course> lieInWait(const Situation& situation);

}  // namespace aquarama::behaviour
