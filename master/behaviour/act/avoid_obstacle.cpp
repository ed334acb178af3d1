// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/avoid_obstacle.h"

#include "master/behaviour/act/pursue.h"

namespace aquarama {

Course avoidObstacle(const Situation& situation) {
    return heading(situation, situation.senses.heading, situation.nature.medium);
}

}  // namespace aquarama
