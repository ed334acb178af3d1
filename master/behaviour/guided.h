// SPDX-License-Identifier: Apache-2.0
// The ways of a fish that is led: with a visitor's drawing past the edge of the wall before the
// viewer, and back behind it; a hunter that a cue has released, before the viewer.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/routines.h"
#include "master/fish/wearers.h"

namespace aquarama::behaviour {

// Where such a fish begins to be seen, and where it shows itself: world frame, metres. Both lie in
// the water.
[[nodiscard]] glm::vec3 entranceOf(const fish::Wearers& wearers,
                                   const fish::Wearer& wearer,
                                   const place::Obstacles& obstacles);
[[nodiscard]] glm::vec3 greetingPlaceOf(const fish::Wearers& wearers,
                                        const fish::Wearer& wearer,
                                        const place::Obstacles& obstacles);

// Where a hunter that a cue has released comes to: before the viewer, in the water.
[[nodiscard]] glm::vec3 hunterPlaceOf(const fish::Wearers& wearers,
                                      const place::Obstacles& obstacles);

// Whether a fish has come to such a place.
[[nodiscard]] bool isAt(glm::vec3 position, glm::vec3 place);

// The course of a fish, led where it enters or leaves, or comes as a released hunter. What flees or
// avoids is not led; a hunter gives way to obstacles alone.
[[nodiscard]] fish::Course guided(const Situation& situation,
                                  const fish::Mind& mind,
                                  const fish::Course& course);

}  // namespace aquarama::behaviour
