// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel/mental_state.h"

#include <algorithm>

#include "master/behaviour/perceive/stimulus.h"
#include "master/fish/drives.h"

namespace aquarama {

namespace {

// No stimulus tempts those who never mate.
float libidoOf(const Nature& nature, const Mind& mind, const Senses& senses, float hunger) {
    if (!mates(nature)) return 0;
    const float stimulus = stimulusOf(kMateStimulus, senses.mate.distance / senses.length);
    return std::min(1.0F, innerLibido(nature, mind, hunger) + kLibidoStimulus * stimulus);
}

// A predator is not tempted: it hunts when it is hungry.
float hungerOf(const Nature& nature, const Mind& mind, const Senses& senses) {
    if (isGorged(nature, mind)) return 0;
    const float inner = innerHunger(nature, mind);
    if (nature.role == Role::Predator) return inner;
    const float stimulus = stimulusOf(kFoodStimulus, senses.food.distance / senses.length);
    return std::min(1.0F, inner + kHungerStimulus * stimulus);
}

}  // namespace

Feelings feel(const Nature& nature, const Mind& mind, const Senses& senses) {
    Feelings feelings;
    feelings.hunger = hungerOf(nature, mind, senses);
    feelings.libido = libidoOf(nature, mind, senses, feelings.hunger);
    for (std::size_t i = 0; i < senses.predatorCount; ++i) {
        const float fear = std::min(nature.fearMetres / senses.predators[i].distance, 1.0F);
        feelings.fear = std::min(1.0F, feelings.fear + fear);
        feelings.greatestFear = std::max(feelings.greatestFear, fear);
    }
    return feelings;
}

}  // namespace aquarama
