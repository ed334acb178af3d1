// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "common/place/angle.h"
#include "master/behaviour/act/company.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

// A push within 12 degrees of straight back says nothing of a side.
constexpr float kHeadOn = 0.2F;

// Of a push straight back, from which a fish wants to stop.
constexpr float kStopsAt = 3.0F;

// Of a side that the push leaves open: towards the middle of the water.
float openSide(const Situation& situation, glm::vec3 right) {
    const glm::vec3 middle = situation.environment.surroundings->obstacles.water.centre;
    return place::dot(middle - situation.senses.position, right) < 0 ? -1.0F : 1.0F;
}

}  // namespace

glm::vec3 wayRound(const Situation& situation) {
    const Senses& senses = situation.senses;
    const float back = -place::dot(senses.push, senses.heading);
    if (back <= 0) return senses.push;
    const glm::vec3 right = place::directionOf({-senses.heading.z, 0, senses.heading.x}, {0, 0, 1});
    const float aside = place::dot(senses.push, right);
    const float up = senses.push.y + back * senses.heading.y;
    if (aside * aside + up * up > kHeadOn * kHeadOn * back * back) return senses.push;
    const bool even = std::abs(aside) < 0.05F * back;
    const float side = even ? openSide(situation, right) : (aside < 0 ? -1.0F : 1.0F);
    return senses.push + right * (side * back);
}

fish::Course avoidObstacle(const Situation& situation, const fish::Mind& mind) {
    if ((mind.likes & fish::kLikesSchooling) != 0 &&
        situation.parameters.habits.role == config::Role::Prey)
        return school(situation);
    const Senses& senses = situation.senses;
    const float back = std::max(0.0F, -place::dot(senses.push, senses.heading));
    const fish::SpeciesParameters& parameters = situation.parameters;
    // Who is run into must not stop.
    const float pace = senses.hurry > 0
                           ? parameters.slow + (parameters.fast - parameters.slow) * senses.hurry
                           : parameters.slow * std::max(0.0F, 1 - back / kStopsAt);
    return heading(situation, senses.heading + roomFrom(situation), pace);
}

}  // namespace aquarama::behaviour
