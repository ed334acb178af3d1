// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/avoid_fish.h"

#include "common/place/angle.h"
#include "master/behaviour/act/pursue.h"

namespace aquarama {

Course avoidFish(const Situation& situation) {
    const Senses& senses = situation.senses;
    const glm::vec3 away = directionOf(-senses.collision.offset, {0, 1, 0});
    return heading(situation, senses.heading + away, situation.nature.slow);
}

}  // namespace aquarama
