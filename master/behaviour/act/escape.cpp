// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/place/angle.h"
#include "master/behaviour/act/company.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

constexpr float kFlee = 2.5F;        // against the unit vector of one's own course
constexpr float kSharpStart = 1.0F;  // urgency from which the motor turns sharply

// 0 where it only just leaves its school, 1 where the predator is so near that nothing else counts.
float dread(const fish::SpeciesParameters& parameters, const fish::Feelings& feelings) {
    const float more = feelings.greatestFear - parameters.habits.fearAlone;
    return std::clamp(more / std::max(1 - parameters.habits.fearAlone, 0.01F), 0.0F, 1.0F);
}

}  // namespace

fish::Course escape(const Situation& situation, const fish::Mind& mind) {
    const Senses& senses = situation.senses;
    const glm::vec3 desired = senses.heading + flightFrom(situation) * kFlee + roomFrom(situation);
    fish::Course course = heading(situation, desired, situation.parameters.fast);
    if ((mind.likes & fish::kLikesSchooling) != 0) {
        const float alone = dread(situation.parameters, situation.feelings);
        const glm::vec3 together = school(situation).direction;
        course.direction = place::levelled(
            place::directionOf(together + (course.direction - together) * alone, course.direction));
    }
    course.urgency = std::max(course.urgency, kSharpStart);
    return course;
}

}  // namespace aquarama::behaviour
