// SPDX-License-Identifier: Apache-2.0
// What hands before the wall do to a fish that is at ease: a quick one makes it shy, one that holds
// still makes it curious. No hand steers a fish that has something to do.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

// Unit vectors (zero where there is nothing) and how strong each is, 0 to 1. World frame.
struct HandSenses {
    glm::vec3 away{};  // out of the way of quick hands
    float shy = 0;
    glm::vec3 towards{};  // to the nearest hand that holds still
    float metres = 0;     // to where fish gather about it
    float curious = 0;
};

// Of a fish at this place with this heading: by how bold it is, 0 to 1.
[[nodiscard]] HandSenses feelHands(const surroundings::HeldHands& held,
                                   glm::vec3 position,
                                   glm::vec3 heading,
                                   float boldness);

// Where the nearest hand is met, world frame; there is one at least.
[[nodiscard]] glm::vec3 nearestHand(const surroundings::HeldHands& held, glm::vec3 position);

// The course of a fish that is at ease, bent by the hands; other courses stay.
[[nodiscard]] fish::Course bentByHands(const Situation& situation,
                                       const fish::Mind& mind,
                                       const fish::Course& course);

}  // namespace aquarama::behaviour
