// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/eat.h"

#include "master/behaviour/act/pursue.h"

namespace aquarama {

Course eat(const Situation& situation, Mind& mind, Deeds& deeds) {
    const Sighting& food = situation.senses.food;
    if (food.distance < 0.5F * situation.senses.length) {
        deeds.push_back({DeedKind::EatParticle, situation.fish, food.object});
        ++mind.eaten;
        mind.sinceMeal = 0;
    }
    return pursue(situation, food.offset, situation.nature.medium);
}

}  // namespace aquarama
