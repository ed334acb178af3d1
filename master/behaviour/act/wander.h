// SPDX-License-Identifier: Apache-2.0
// Goes from place to place of the fish's own, in no hurry, round what is in its way.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "common/units/ids.h"
#include "master/behaviour/act/routine.h"

namespace aquarama {

// Where a fish is bound for, in its water. Another place every quarter of a minute.
[[nodiscard]] glm::vec3 wanderingGoal(std::uint32_t seed,
                                      const Region& water,
                                      std::size_t fish,
                                      Tick tick);

[[nodiscard]] Course wander(const Situation& situation);

}  // namespace aquarama
