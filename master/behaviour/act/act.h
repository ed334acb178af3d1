// SPDX-License-Identifier: Apache-2.0
// The last stage of a thought: the routine of the intention takes its step.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama {

[[nodiscard]] Course act(const Situation& situation, Mind& mind, Deeds& deeds);

}  // namespace aquarama
