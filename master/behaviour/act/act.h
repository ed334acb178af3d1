// SPDX-License-Identifier: Apache-2.0
// The last stage of a thought: the routine of the intention takes its step.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

[[nodiscard]] fish::Course act(const Situation& situation,
                               fish::Mind& mind,
                               DeferredEvents& events);

}  // namespace aquarama::behaviour
