// SPDX-License-Identifier: Apache-2.0
// Flees from all predators in sight, the nearer the more, as fast as it can.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama {

[[nodiscard]] Course escape(const Situation& situation);

}  // namespace aquarama
