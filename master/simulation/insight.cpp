// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/insight.h"

#include "master/behaviour/perceive/perceive.h"

namespace aquarama::simulation {

std::optional<Insight> insightInto(const world::World& world, std::uint32_t fish) {
    if (fish >= world.traits().size()) return std::nullopt;
    const behaviour::Environment environment = world.environment();
    const fish::FishView& view = *environment.view;
    const fish::Courses& courses = world.courses();
    const motion::MotionStates& states = world.states();
    Insight insight;
    insight.fish = fish;
    insight.tick = world.tick();
    insight.parameters = environment.speciesParameters[view.kind[fish]];
    insight.lengthMetres = static_cast<float>(world.traits()[fish].lengthMillimetres) * 0.001F;
    insight.away = view.shows(fish, fish::kAway);
    insight.mind = world.minds()[fish];
    insight.course = courses[fish];
    insight.segment = static_cast<motion::Action>(states.segment[fish]);
    insight.phase = static_cast<float>(states.phase[fish]) / 65536.0F;
    insight.swims = motion::speedBodyLengths(states, fish);
    if (insight.away) return insight;
    insight.senses = behaviour::perceive(environment, insight.parameters, fish, insight.mind);
    insight.feelings = behaviour::feel(insight.parameters, insight.mind, insight.senses);
    insight.reasoning =
        behaviour::reason(insight.parameters, insight.mind, insight.senses, insight.feelings);
    return insight;
}

}  // namespace aquarama::simulation
