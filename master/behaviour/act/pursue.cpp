// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/pursue.h"

#include <algorithm>

#include "common/place/angle.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

// Distances in body lengths. A biomechanical fish can still correct its way within the first; this
// motor, which plays turns to their end, begins from the second (paper, section 5.2).
constexpr float kCarefulWithin = 2.5F;
constexpr float kEarlierWithin = 5.0F;
constexpr float kGeneralCosine = 0.94F;  // 20 degrees: near enough a direction from far off
constexpr float kTurnsWithin = 1.5F;     // a nearer target abeam would only be circled
constexpr float kAbeamCosine = 0.5F;
constexpr float kTurningPace = 0.6F;  // of slow, while turning towards it
constexpr float kCarefulPace = 0.8F;  // of slow, at the target
constexpr float kMostLeadSeconds = 1.5F;

// Where the target will be when the fish can be there.
glm::vec3 lead(const Situation& situation, glm::vec3 towards, float speed, glm::vec3 velocity) {
    const float metresPerSecond = std::max(0.05F, speed * situation.senses.length);
    return towards +
           velocity * std::min(kMostLeadSeconds, place::lengthOf(towards) / metresPerSecond);
}

}  // namespace

fish::Course pursue(const Situation& situation,
                    glm::vec3 towards,
                    float speed,
                    glm::vec3 velocity) {
    const Senses& senses = situation.senses;
    const float slow = situation.parameters.slow;
    const glm::vec3 to = lead(situation, towards, speed, velocity);
    const glm::vec3 direction = place::directionOf(to, senses.heading);
    const float lengths = place::lengthOf(to) / senses.length;
    const float along = place::dot(direction, senses.heading);
    const float careful =
        situation.environment.adaptation.earlierPursuit ? kEarlierWithin : kCarefulWithin;
    if (lengths >= careful)
        return heading(situation, along > kGeneralCosine ? senses.heading : direction, speed);
    if (lengths < kTurnsWithin && along < kAbeamCosine)
        return heading(situation, direction, kTurningPace * slow);
    const float least = std::min(speed, kCarefulPace * slow);
    // A target that swims off must be swum after.
    const float chase = std::max(0.0F, place::dot(velocity, direction)) / senses.length;
    const float pace = least + (speed - least) * lengths / careful;
    return heading(situation, direction, std::min(speed, pace + chase));
}

fish::Course heading(const Situation& situation, glm::vec3 desired, float speed) {
    const Senses& senses = situation.senses;
    const glm::vec3 direction =
        place::levelled(place::directionOf(desired + wayRound(situation), senses.heading));
    return {direction, speed, senses.urgency};
}

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
