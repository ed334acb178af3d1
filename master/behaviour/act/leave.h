// SPDX-License-Identifier: Apache-2.0
// Leaves for water whose light and warmth suit its habits.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama {

[[nodiscard]] Course leave(const Situation& situation);

}  // namespace aquarama
