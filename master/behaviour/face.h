// SPDX-License-Identifier: Apache-2.0
// What the face of a fish shows of its thought: how far its mouth is open, and where it looks.
// Nodes draw it; no mind perceives it.
#pragma once

#include <span>

#include "master/behaviour/routines.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

// After act(): the mind has what it decided; own: the events that this thought has reported.
[[nodiscard]] fish::Face faceOf(const Situation& situation,
                                const fish::Mind& mind,
                                std::span<const fish::DeferredEvent> own);

}  // namespace aquarama::behaviour
