// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/think.h"

#include <cassert>

#include "master/behaviour/intention_generator.h"
#include "master/behaviour/mental_state.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           DeferredEvents& events) {
    assert(fish < minds.size() && fish < courses.size() && fish < environment.view->size());
    const fish::SpeciesParameters& parameters =
        environment.speciesParameters[environment.view->kind[fish]];
    fish::Mind mind = minds[fish];
    fish::passTime(parameters, mind);
    const Senses senses = perceive(environment, parameters, fish, mind);
    const fish::Feelings feelings = feel(parameters, mind, senses);
    remember(mind, decide(parameters, mind, senses, feelings));
    fish::Course course = act({environment, parameters, fish, senses, feelings}, mind, events);
    course.openToChange = environment.adaptation.recommendations &&
                          acceptsRecommendation(parameters, mind, senses, feelings);
    courses[fish] = course;
    minds[fish] = mind;
}

}  // namespace aquarama::behaviour
