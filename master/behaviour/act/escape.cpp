// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/escape.h"

#include "common/place/angle.h"
#include "master/behaviour/act/pursue.h"

namespace aquarama {

Course escape(const Situation& situation) {
    const Senses& senses = situation.senses;
    glm::vec3 away{};
    for (std::size_t i = 0; i < senses.predatorCount; ++i) {
        const Sighting& predator = senses.predators[i];
        away -= predator.offset / (predator.distance * predator.distance + 0.01F);
    }
    Course course = heading(situation, directionOf(away, senses.heading), situation.nature.fast);
    course.urgency = std::max(course.urgency, 1.0F);
    return course;
}

}  // namespace aquarama
