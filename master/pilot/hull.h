// SPDX-License-Identifier: Apache-2.0
// What the submarine must not run into: sand, rocks, kelp, the surface and the borders of the
// scene. World frame, metres.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "master/surroundings/chart.h"

namespace aquarama::pilot {

inline constexpr float kHullRadiusMetres = 0.5F;  // about the eye: nothing comes nearer to it
inline constexpr float kStandOffMetres = 0.25F;   // off the hull, where it is pushed back
inline constexpr float kBrakingMetres = 1.1F;     // a second squared, before an obstacle

// Where the submarine may go.
struct Waters {
    place::PlaceKey place;
    place::Region region;
    std::vector<place::Rock> rocks;
    std::vector<surroundings::Stem> stems;
};
[[nodiscard]] Waters watersOf(const place::PlaceKey& place,
                              const place::Region& fishWater,
                              glm::vec3 eye);

// How far the hull is from all of it; negative inside something.
[[nodiscard]] float gapAt(const Waters& waters, glm::vec3 position);

// One tick of movement. What leads at an obstacle is braked in time, so that it comes to rest at
// the stand-off, and within that it is led away gently. Never ends inside anything that the hull
// was outside of.
void moveHull(const Waters& waters, glm::vec3& position, glm::vec3& velocity);

}  // namespace aquarama::pilot
