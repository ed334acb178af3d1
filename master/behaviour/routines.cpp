// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

fish::Course act(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    switch (mind.intention) {
        case fish::Intention::AvoidObstacle:
            return avoidObstacle(situation, mind);
        case fish::Intention::AvoidFish:
            return avoidFish(situation, mind);
        case fish::Intention::Escape:
            return escape(situation, mind);
        case fish::Intention::Eat:
            return situation.parameters.habits.role == config::Role::Predator
                       ? hunt(situation, mind, events)
                       : eat(situation, mind, events);
        case fish::Intention::Mate:
            return mate(situation, mind, events);
        case fish::Intention::School:
            return school(situation);
        case fish::Intention::Leave:
            return leave(situation);
        case fish::Intention::Wander:
            break;
    }
    return wander(situation);
}

}  // namespace aquarama::behaviour
