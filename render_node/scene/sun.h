// SPDX-License-Identifier: Apache-2.0
// Where the sun stands.
#pragma once

#include <glm/vec3.hpp>

namespace aquarama {

// Towards the sun as seen in the water: before the wall and to its left, 55 degrees up.
[[nodiscard]] glm::vec3 sunInWater();

}  // namespace aquarama
