// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/think.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "master/behaviour/curiosity.h"
#include "master/behaviour/face.h"
#include "master/behaviour/guided.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           DeferredEvents& events) {
    assert(fish < minds.size());
    assert(fish < courses.size());
    assert(fish < environment.view->size());
    const fish::SpeciesParameters& parameters =
        environment.speciesParameters[environment.view->kind[fish]];
    fish::Mind mind = minds[fish];
    // The first thought of a mind is as long after its beginning as any other.
    const std::uint64_t since = environment.tick.value - mind.thoughtAt;
    fish::passTime(
        parameters, static_cast<std::uint32_t>(std::min(since, fish::kTicksBetweenThoughts)), mind);
    mind.thoughtAt = environment.tick.value;
    const Senses senses = perceive(environment, parameters, fish, mind);
    const fish::Feelings feelings = feel(parameters, mind, senses);
    remember(mind, decide(parameters, mind, senses, feelings));
    const Situation situation{environment, parameters, fish, senses, feelings};
    const std::size_t reported = events.size();
    fish::Course course =
        guided(situation, mind, bentByHands(situation, mind, act(situation, mind, events)));
    course.face = faceOf(situation, mind, std::span(events).subspan(reported));
    course.openToChange = environment.adaptation.recommendations &&
                          acceptsRecommendation(parameters, mind, senses, feelings);
    courses[fish] = course;
    minds[fish] = mind;
}

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
        case fish::Intention::Rest:
            return rest(situation);
        case fish::Intention::Hide:
            return hide(situation, mind);
        case fish::Intention::Charge:
            return charge(situation, mind, events);
        case fish::Intention::Graze:
            return graze(situation, mind, events);
        case fish::Intention::Hover:
            return hover(situation);
        case fish::Intention::Clean:
            return clean(situation, mind);
        case fish::Intention::Visit:
            return visit(situation, mind);
        case fish::Intention::Wander:
            break;
    }
    return wander(situation);
}

}  // namespace aquarama::behaviour
