// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/mental_state.h"

#include <algorithm>

#include "master/behaviour/perceive/stimulus.h"
#include "master/fish/drives.h"

namespace aquarama::behaviour {

namespace {

constexpr float kFearOfIdle = 0.5F;

// No stimulus tempts those who never mate.
float libidoOf(const fish::SpeciesParameters& parameters,
               const fish::Mind& mind,
               const Senses& senses,
               float hunger) {
    if (!fish::mates(parameters)) return 0;
    const float stimulus = stimulusOf(kMateStimulus, senses.mate.distance / senses.length);
    return std::min(1.0F, fish::innerLibido(parameters, mind, hunger) + kLibidoStimulus * stimulus);
}

// A predator is not tempted: it hunts when it is hungry.
float hungerOf(const fish::SpeciesParameters& parameters,
               const fish::Mind& mind,
               const Senses& senses) {
    if (fish::isGorged(parameters, mind)) return 0;
    const float inner = fish::innerHunger(parameters, mind);
    if (parameters.habits.role == config::Role::Predator) return inner;
    const float stimulus = stimulusOf(kFoodStimulus, senses.food.distance / senses.length);
    return std::min(1.0F, inner + kHungerStimulus * stimulus);
}

// Tu's F_i = min(D0 / d_i, 1). A predator that is after nobody frightens less: fish keep an eye on
// it and go on eating (threat sensitivity: Helfman 1989, Behav. Ecol. Sociobiol. 24:47).
float fearOf(const fish::SpeciesParameters& parameters, const Sighting& predator) {
    const float heeded = predator.hunting ? 1.0F : kFearOfIdle;
    return heeded * std::min(parameters.habits.fearMetres / predator.distance, 1.0F);
}

}  // namespace

fish::Feelings feel(const fish::SpeciesParameters& parameters,
                    const fish::Mind& mind,
                    const Senses& senses) {
    fish::Feelings feelings;
    feelings.hunger = hungerOf(parameters, mind, senses);
    feelings.libido = libidoOf(parameters, mind, senses, feelings.hunger);
    for (std::size_t i = 0; i < senses.predatorCount; ++i) {
        const float fear = fearOf(parameters, senses.predators[i]);
        feelings.fear = std::min(1.0F, feelings.fear + fear);
        feelings.greatestFear = std::max(feelings.greatestFear, fear);
    }
    return feelings;
}

}  // namespace aquarama::behaviour
