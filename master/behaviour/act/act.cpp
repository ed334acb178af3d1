// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/act.h"

#include "master/behaviour/act/avoid_fish.h"
#include "master/behaviour/act/avoid_obstacle.h"
#include "master/behaviour/act/eat.h"
#include "master/behaviour/act/escape.h"
#include "master/behaviour/act/hunt.h"
#include "master/behaviour/act/leave.h"
#include "master/behaviour/act/mate.h"
#include "master/behaviour/act/school.h"
#include "master/behaviour/act/wander.h"

namespace aquarama {

Course act(const Situation& situation, Mind& mind, Deeds& deeds) {
    switch (mind.intention) {
        case Intention::AvoidObstacle:
            return avoidObstacle(situation, mind);
        case Intention::AvoidFish:
            return avoidFish(situation, mind);
        case Intention::Escape:
            return escape(situation, mind);
        case Intention::Eat:
            return situation.nature.role == Role::Predator ? hunt(situation, mind, deeds)
                                                           : eat(situation, mind, deeds);
        case Intention::Mate:
            return mate(situation, mind, deeds);
        case Intention::School:
            return school(situation);
        case Intention::Leave:
            return leave(situation);
        case Intention::Wander:
            break;
    }
    return wander(situation);
}

}  // namespace aquarama
