// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/leave.h"

#include "master/behaviour/act/pursue.h"

namespace aquarama {

Course leave(const Situation& situation) {
    const Senses& senses = situation.senses;
    const float up =
        senses.light < static_cast<float>(situation.nature.habits.light.least) ? 1.0F : -1.0F;
    return heading(situation, senses.heading + glm::vec3{0, 0.4F * up, 0}, situation.nature.slow);
}

}  // namespace aquarama
