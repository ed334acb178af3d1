// SPDX-License-Identifier: Apache-2.0
// What a fish must not swim into: sand, rocks, the borders of its water and the surface.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"

namespace aquarama {

struct Obstacles {
    PlaceKey place;
    Region water;
    std::vector<Rock> rocks;  // only those that reach into the water
};
[[nodiscard]] Obstacles obstaclesOf(const PlaceKey& place, const Region& water);

// Where the obstacles push a fish that swims from `position` along `heading`. Its length is 0 in
// the open and grows past 1 where only turning away matters; the path is felt `reachMetres` ahead,
// further than a biomechanical fish would need (paper, section 5.2).
[[nodiscard]] glm::vec3 avoidance(const Obstacles& obstacles,
                                  glm::vec3 position,
                                  glm::vec3 heading,
                                  float reachMetres);

// Away from where the path passes nearest to a ball, as above.
[[nodiscard]] glm::vec3 ballPush(
    glm::vec3 centre, float radius, glm::vec3 position, glm::vec3 heading, float reachMetres);

}  // namespace aquarama
