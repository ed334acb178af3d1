// SPDX-License-Identifier: Apache-2.0
// Swims with the school: separation, alignment and cohesion with the nearest seen, the school's
// common way, and no global control.
#pragma once

#include <cstddef>
#include <cstdint>

#include "master/behaviour/act/routine.h"

namespace aquarama::behaviour {

// How far from its goal a school of so many fish reaches at ease.
[[nodiscard]] float schoolRadiusMetres(std::size_t fish);

// Of a bait ball every fish keeps a level of its own, -1 at its bottom to 1 at its top, more of
// them near the middle; else all would mill in one flat ring.
[[nodiscard]] float levelInBall(std::uint32_t seed, std::uint32_t fish);

[[nodiscard]] fish::Course school(const Situation& situation);

}  // namespace aquarama::behaviour
