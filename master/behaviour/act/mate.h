// SPDX-License-Identifier: Apache-2.0
// Courts the mate of its intention: looping, circling, spawning ascent, nuzzling (Tu 1996,
// section 5.6).
#pragma once

#include "master/behaviour/act/routine.h"

namespace aquarama {

[[nodiscard]] Course mate(const Situation& situation, Mind& mind, Deeds& deeds);

}  // namespace aquarama
