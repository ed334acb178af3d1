// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/flight.h"

#include <algorithm>

#include "common/place/angle.h"

namespace aquarama::behaviour {

namespace {

constexpr float kAsideOfItsWay = 1.2F;          // against straight away, for one right before it
constexpr float kNearestSquaredMetres = 0.01F;  // nearer than this does not count more

glm::vec3 awayFrom(glm::vec3 offset, glm::vec3 course, glm::vec3 otherwise) {
    const glm::vec3 away = place::directionOf(-offset, otherwise);
    const float before = place::dot(away, course);
    if (before <= 0) return place::directionOf(away, otherwise);
    const glm::vec3 aside = place::directionOf(away - course * before, otherwise);
    return place::directionOf(away + aside * (kAsideOfItsWay * before), otherwise);
}

}  // namespace

glm::vec3 flightFrom(const Situation& situation) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const glm::vec3 side = place::directionOf({-senses.heading.z, 0, senses.heading.x}, {0, 0, 1});
    glm::vec3 flight{};
    for (std::size_t i = 0; i < senses.predatorCount; ++i) {
        const Sighting& predator = senses.predators[i];
        const float squared =
            std::max(predator.distance * predator.distance, kNearestSquaredMetres);
        flight += awayFrom(predator.offset, view.heading(predator.object), side) / squared;
    }
    return place::directionOf(flight, {});
}

}  // namespace aquarama::behaviour
