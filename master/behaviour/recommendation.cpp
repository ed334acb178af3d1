// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/recommendation.h"

namespace aquarama::behaviour {

namespace {

constexpr float kCalm = 0.15F;                 // urgency up to which there is room for a whim
constexpr float kMealIsFarBodyLengths = 6.0F;  // beyond, it merely swims in its direction

bool isFarFromMeal(const fish::SpeciesParameters& parameters, const Senses& senses) {
    const Sighting& meal =
        parameters.habits.role == config::Role::Predator ? senses.prey : senses.food;
    return meal.distance > kMealIsFarBodyLengths * senses.length;
}

}  // namespace

bool acceptsRecommendation(const fish::SpeciesParameters& parameters,
                           const fish::Mind& mind,
                           const Senses& senses,
                           const fish::Feelings& feelings) {
    if (senses.urgency > kCalm || feelings.fear > parameters.habits.fearFrom) return false;
    switch (mind.intention) {
        case fish::Intention::Wander:
        case fish::Intention::Leave:
        case fish::Intention::School:
            return true;
        case fish::Intention::Eat:
            return isFarFromMeal(parameters, senses);
        case fish::Intention::Mate:
        case fish::Intention::Escape:
        case fish::Intention::AvoidFish:
        case fish::Intention::AvoidObstacle:
            break;
    }
    return false;
}

}  // namespace aquarama::behaviour
