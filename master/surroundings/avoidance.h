// SPDX-License-Identifier: Apache-2.0
// How fish keep clear of sand, rocks, kelp, the borders of their water and the surface. World
// frame, metres.
#pragma once

#include <glm/vec3.hpp>

#include "common/place/obstacles.h"

namespace aquarama::surroundings {

// How far a fish keeps from boulders and sand: at the clearance from them it turns away, from the
// margin before that on it is pushed. Metres.
struct Berth {
    float rockClearance = 0.3F, rockMargin = 0.6F;
    float sandClearance = 0.35F, sandMargin = 0.45F;
};
// Of a fish of this length: small ones live closer to the reef.
[[nodiscard]] Berth berthOf(float lengthMetres);
// Of a fish that lives at a site, near its home: boulders are worn within their radius.
inline constexpr Berth kAtHome{-0.05F, 0.12F, 0.05F, 0.1F};
// Of a fish that goes down to a boulder and bites.
inline constexpr Berth kAtTurf{-0.3F, 0.1F, 0.02F, 0.08F};
// Of a fish that goes into a shelter.
inline constexpr Berth kIntoShelter{-0.3F, 0.1F, 0.02F, 0.05F};

// Height y of the sand, or of the boulder that is highest there, at (x, z), metres.
[[nodiscard]] float groundAt(const place::Obstacles& obstacles, glm::vec2 xz);

// The push of the obstacles on a fish that swims from `position` along `heading` (unit vector). The
// result has length 0 in open water; at 1 and more only turning away matters. The path is tested
// `reachMetres` (above 0) ahead, farther than a biomechanical fish would need (paper, section 5.2).
[[nodiscard]] glm::vec3 avoidance(const place::Obstacles& obstacles,
                                  glm::vec3 position,
                                  glm::vec3 heading,
                                  float reachMetres,
                                  const Berth& berth = {});

// The same push, computed by testing every obstacle. It differs by at most 0.1, where the sand
// pushes hardest, and not at all away from the sand. The reference for tests, and used off the
// chart.
[[nodiscard]] glm::vec3 plainAvoidance(const place::Obstacles& obstacles,
                                       glm::vec3 position,
                                       glm::vec3 heading,
                                       float reachMetres,
                                       const Berth& berth = {});

// The push away from a ball, from the point where the path passes nearest to it, begun at a margin
// before it; units as above.
[[nodiscard]] glm::vec3 ballPush(glm::vec3 centre,
                                 float radius,
                                 float marginMetres,
                                 glm::vec3 position,
                                 glm::vec3 heading,
                                 float reachMetres);

}  // namespace aquarama::surroundings
