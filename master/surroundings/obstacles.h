// SPDX-License-Identifier: Apache-2.0
// What a fish must not swim into: sand, rocks, kelp, the borders of its water and the surface.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "master/surroundings/climate.h"

namespace aquarama::surroundings {

struct Obstacles {
    place::PlaceKey place;
    place::Region water;
    std::vector<place::Rock> rocks;  // only those that reach into the water
    std::vector<Stem> stems = {};    // likewise
    Chart chart = {};                // of all that; without one all is looked at each time
};
[[nodiscard]] Obstacles obstaclesOf(const place::PlaceKey& place, const place::Region& water);

// Where the obstacles push a fish that swims from `position` along `heading`. Its length is 0 in
// the open and grows past 1 where only turning away matters; the path is felt `reachMetres` ahead,
// further than a biomechanical fish would need (paper, section 5.2).
[[nodiscard]] glm::vec3 avoidance(const Obstacles& obstacles,
                                  glm::vec3 position,
                                  glm::vec3 heading,
                                  float reachMetres);

// The same without the chart; it differs by 0.1 at most, where the sand pushes hardest, and not at
// all away from the sand.
[[nodiscard]] glm::vec3 plainAvoidance(const Obstacles& obstacles,
                                       glm::vec3 position,
                                       glm::vec3 heading,
                                       float reachMetres);

// Away from where the path passes nearest to a ball, as above.
[[nodiscard]] glm::vec3 ballPush(
    glm::vec3 centre, float radius, glm::vec3 position, glm::vec3 heading, float reachMetres);

}  // namespace aquarama::surroundings
