// SPDX-License-Identifier: Apache-2.0
// How much water a scene gives to how many fish.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/config/scene.h"
#include "common/place/place.h"

namespace aquarama::place {

// The water of a scene for so many fish of a mean length: the scene's own box, or a larger one with
// SceneWater::leastLengthsCubed for each fish. It grows to both sides and away from the eye; in the
// open sea also downwards. The face towards the eye and the top stay.
[[nodiscard]] Region waterFor(const config::Scene& scene, std::size_t fish, float meanLengthMetres);

// Where the submarine may go: the box around the fish's water and the eye, with a margin of four
// metres, below the surface. Takes no account of the sand.
[[nodiscard]] Region roamingRegion(const Region& fishWater, glm::vec3 eye);

// How many fish have room: a reef is bounded by its rocks, the open sea only by kMostFish.
[[nodiscard]] std::uint32_t mostFishIn(const config::Scene& scene, float meanLengthMetres);

// Throws Error at the first member's place in the scene's file where `fish`, of all members, are
// more than have room; and at the place of the box, the eye or a stop of the tour where it is below
// the floor, or where a stop is outside of roamingRegion(). The scene has at least one member.
void checkRoom(const config::Scene& scene,
               const std::string& scenePath,
               std::size_t fish,
               float meanLengthMetres);

}  // namespace aquarama::place
