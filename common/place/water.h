// SPDX-License-Identifier: Apache-2.0
// How much water a scene gives to how many fish.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/config/scene.h"
#include "common/place/place.h"

namespace aquarama::place {

// The water of a scene for so many fish of a mean length: its own box, or a larger one with
// SceneWater::leastLengthsCubed for each. It grows to both sides and away from the eye; in the open
// sea downwards, too. The face towards the eye and the top stay.
[[nodiscard]] Region waterFor(const config::Scene& scene, std::size_t fish, float meanLengthMetres);

// Where the submarine may go: the fish's water and the eye with four metres about them, below the
// surface. The sand is not asked.
[[nodiscard]] Region roamingRegion(const Region& fishWater, glm::vec3 eye);

// So many have room: a reef ends where its rocks do, an open sea only at its floor.
[[nodiscard]] std::uint32_t mostFishIn(const config::Scene& scene, float meanLengthMetres);

// Throws Error at the first member's place in the scene's file where `fish`, of all members, are
// more than have room; and where the box, the eye or a stop of the tour is below the floor, or a
// stop out of where the submarine may go.
void checkRoom(const config::Scene& scene,
               const std::string& scenePath,
               std::size_t fish,
               float meanLengthMetres);

}  // namespace aquarama::place
