// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/escape.h"

#include <algorithm>

#include "common/place/angle.h"
#include "master/behaviour/act/company.h"
#include "master/behaviour/act/flight.h"
#include "master/behaviour/act/pursue.h"

namespace aquarama {

namespace {

constexpr float kFlee = 2.5F;        // against the unit vector of one's own course
constexpr float kSharpStart = 1.0F;  // urgency from which the motor turns sharply

}  // namespace

Course escape(const Situation& situation) {
    const Senses& senses = situation.senses;
    const glm::vec3 wish = senses.heading + flightFrom(situation) * kFlee +
                           roomFrom(*situation.environment.view, senses, situation.fish);
    Course course = heading(situation, wish, situation.nature.fast);
    course.urgency = std::max(course.urgency, kSharpStart);
    return course;
}

}  // namespace aquarama
