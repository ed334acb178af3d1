// SPDX-License-Identifier: Apache-2.0
// What a fish must not swim into: sand, rocks, the borders of the school's water, the surface and
// the eye.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"

namespace aquarama {

struct Surroundings {
    std::uint32_t placeSeed = 0;
    Region water;
    std::vector<Rock> rocks;  // only those that reach into the water
};
[[nodiscard]] Surroundings surroundingsOf(std::uint32_t placeSeed);

// No fish comes nearer to the eye: nearer, it would fill the wall.
inline constexpr float kNearestToEyeMetres = 0.9F;

// Where the surroundings push a fish that swims from `position` along `heading`. Its length is 0 in
// the open and grows past 1 where only turning away matters; the path is felt `reachMetres` ahead,
// further than a biomechanical fish would need (paper, section 5.2).
[[nodiscard]] glm::vec3 avoidance(const Surroundings& surroundings,
                                  glm::vec3 position,
                                  glm::vec3 heading,
                                  float reachMetres);

}  // namespace aquarama
