// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel/mental_state.h"

#include <algorithm>

#include "master/fish/drives.h"

namespace aquarama {

namespace {

// Where libido is by itself it stays 0 for those who never mate.
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

float stimulusOf(const StimulusRange& range, float bodyLengths) {
    const float least = 1 / range.farBodyLengths;
    const float most = 1 / range.nearBodyLengths;
    const float stimulus = 1 / bodyLengths;
    if (stimulus < least) return 0;
    if (stimulus > most) return 1;
    return (stimulus - least) / (2 * most - least - stimulus);
}

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
