// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/think.h"

#include "master/behaviour/act/act.h"
#include "master/behaviour/decide/intention_generator.h"
#include "master/behaviour/decide/recommendation.h"
#include "master/behaviour/feel/mental_state.h"
#include "master/behaviour/perceive/perceive.h"
#include "master/fish/drives.h"

namespace aquarama::behaviour {

void think(const Environment& environment,
           std::uint32_t fish,
           fish::Minds& minds,
           fish::Courses& courses,
           Deeds& deeds) {
    const fish::Nature& nature = environment.natures[environment.view->kind[fish]];
    fish::Mind mind = minds[fish];
    fish::passTime(nature, mind);
    const Senses senses = perceive(environment, nature, fish, mind);
    const Feelings feelings = feel(nature, mind, senses);
    remember(mind, decide(nature, mind, senses, feelings));
    fish::Course course = act({environment, nature, fish, senses, feelings}, mind, deeds);
    course.openToChange = environment.adaptation.recommendations &&
                          acceptsRecommendation(nature, mind, senses, feelings);
    courses[fish] = course;
    minds[fish] = mind;
}

}  // namespace aquarama::behaviour
