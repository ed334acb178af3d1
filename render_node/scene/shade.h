// SPDX-License-Identifier: Apache-2.0
// Where the sun stands, and how much of it and of the light from above the boulders take away:
// computed once, as neither sun nor rock moves.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "render_node/scene/mesh.h"

namespace aquarama::scene {

// Towards the sun as seen in the water: before the wall and to its left, 55 degrees up.
[[nodiscard]] glm::vec3 sunInWater();

// 0 dark to 1 open. Boulders count as balls; soft edges, as the sun's light is already spread.
[[nodiscard]] float sunOpenness(std::span<const place::Rock> rocks, glm::vec3 place);
[[nodiscard]] float skyOpenness(std::span<const place::Rock> rocks,
                                glm::vec3 place,
                                glm::vec3 normal);

// A boulder's own ball is left to its baked openness.
void shade(Mesh& mesh, std::span<const place::Rock> others);

}  // namespace aquarama::scene
