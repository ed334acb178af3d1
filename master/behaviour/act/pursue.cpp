// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/pursue.h"

#include "common/place/angle.h"

namespace aquarama {

Course pursue(const Situation& situation, glm::vec3 towards, float speed) {
    return heading(situation, directionOf(towards, situation.senses.heading), speed);
}

Course heading(const Situation& situation, glm::vec3 wish, float speed) {
    const Senses& senses = situation.senses;
    const glm::vec3 direction = levelled(directionOf(wish + senses.push, senses.heading));
    return {direction, speed, senses.urgency};
}

}  // namespace aquarama
