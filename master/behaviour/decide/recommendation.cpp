// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/decide/recommendation.h"

namespace aquarama {

namespace {

constexpr float kCalm = 0.15F;                 // urgency up to which there is room for a whim
constexpr float kMealIsFarBodyLengths = 6.0F;  // beyond, it merely swims in its direction

bool isFarFromMeal(const Nature& nature, const Senses& senses) {
    const Sighting& meal = nature.role == Role::Predator ? senses.prey : senses.food;
    return meal.distance > kMealIsFarBodyLengths * senses.length;
}

}  // namespace

bool acceptsRecommendation(const Nature& nature,
                           const Mind& mind,
                           const Senses& senses,
                           const Feelings& feelings) {
    if (senses.urgency > kCalm || feelings.fear > nature.fearFrom) return false;
    switch (mind.intention) {
        case Intention::Wander:
        case Intention::Leave:
        case Intention::School:
            return true;
        case Intention::Eat:
            return isFarFromMeal(nature, senses);
        case Intention::Mate:
        case Intention::Escape:
        case Intention::AvoidFish:
        case Intention::AvoidObstacle:
            break;
    }
    return false;
}

}  // namespace aquarama
