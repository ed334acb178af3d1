// SPDX-License-Identifier: Apache-2.0
// Goes for the particle or the prey of its intention and takes it at the mouth.
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama {

[[nodiscard]] Course eat(const Situation& situation, Mind& mind, Deeds& deeds);

}  // namespace aquarama
