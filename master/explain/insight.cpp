// SPDX-License-Identifier: Apache-2.0
#include "master/explain/insight.h"

#include "master/behaviour/perceive/perceive.h"

namespace aquarama {

std::optional<Insight> insightInto(const World& world, std::uint32_t fish) {
    if (fish >= world.traits().size()) return std::nullopt;
    const Environment environment = world.environment();
    const FishView& view = *environment.view;
    const Courses& courses = world.courses();
    const MotionStates& states = world.states();
    Insight insight;
    insight.fish = fish;
    insight.tick = world.tick();
    insight.nature = environment.natures[view.kind[fish]];
    insight.lengthMetres = static_cast<float>(world.traits()[fish].lengthMillimetres) * 0.001F;
    insight.away = view.shows(fish, kAway);
    insight.mind = world.minds()[fish];
    insight.course = courses[fish];
    insight.segment = static_cast<Action>(states.segment[fish]);
    insight.phase = static_cast<float>(states.phase[fish]) / 65536.0F;
    insight.swims = speedBodyLengths(states, fish);
    if (insight.away) return insight;
    insight.senses = perceive(environment, insight.nature, fish, insight.mind);
    insight.feelings = feel(insight.nature, insight.mind, insight.senses);
    insight.reasoning = reason(insight.nature, insight.mind, insight.senses, insight.feelings);
    return insight;
}

}  // namespace aquarama
