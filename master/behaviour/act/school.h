// SPDX-License-Identifier: Apache-2.0
// Swims with the school: separation, alignment and cohesion with the nearest seen, the school's
// common way, and no global control.
#pragma once

#include <cstddef>

#include "master/behaviour/act/routine.h"

namespace aquarama {

// How far from its goal a school of so many fish reaches at ease.
[[nodiscard]] float schoolRadiusMetres(std::size_t fish);

[[nodiscard]] Course school(const Situation& situation);

}  // namespace aquarama
