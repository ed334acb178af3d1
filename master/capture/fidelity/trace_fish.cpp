// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "common/units/ids.h"
#include "master/capture/fidelity/trace.h"

namespace aquarama {

namespace {

constexpr double kSecondsToSteady = 24;  // the fish's own

// Who swims also keeps level and upright, as the replica always does (the paper's section 4.2); a
// fish that is both needs no fins for it.
Order orderFor(const Species& species, Manoeuvre manoeuvre) {
    const Swim& swim = species.swim;
    switch (manoeuvre) {
        case Manoeuvre::ForwardSlow:
            return {.controller = Controller::Balance, .gait = swim.slow};
        case Manoeuvre::ForwardMedium:
        case Manoeuvre::Balance:
            return {.controller = Controller::Balance, .gait = swim.medium};
        case Manoeuvre::ForwardFast:
            return {.controller = Controller::Balance, .gait = swim.fast};
        case Manoeuvre::TurnLeftGradual:
            return {.controller = Controller::LeftTurn, .bend = species.turn.gradual};
        case Manoeuvre::TurnLeftSharp:
            return {.controller = Controller::LeftTurn, .bend = species.turn.sharp};
        case Manoeuvre::TurnRightGradual:
            return {.controller = Controller::RightTurn, .bend = species.turn.gradual};
        case Manoeuvre::TurnRightSharp:
            return {.controller = Controller::RightTurn, .bend = species.turn.sharp};
        case Manoeuvre::Glide:
            return {.controller = Controller::Glide};
        case Manoeuvre::Ascend:
            return {.controller = Controller::Ascend,
                    .gait = swim.medium,
                    .pitchRadians = kScriptPitchRadians};
        case Manoeuvre::Descend:
            return {.controller = Controller::Descend,
                    .gait = swim.medium,
                    .pitchRadians = kScriptPitchRadians};
        case Manoeuvre::Brake:
            return {.controller = Controller::Brake};
        case Manoeuvre::Retreat:
            return {.controller = Controller::Retreat, .gait = swim.slow};
    }
    return {};
}

TracePoint pointOf(const NodeVectors& pose) {
    return {frameOf(pose), inBodyFrame(pose)};
}

}  // namespace

Trace traceFish(const Species& species, std::span<const TimedOrder> orders) {
    const double longest = longestStepSeconds(makeBiomechanicalFish(species));
    const int stepsPerTick = static_cast<int>(std::ceil(1 / (kTicksPerSecond * longest) - 1e-9));
    Swimmer swimmer(species, 1 / (kTicksPerSecond * stepsPerTick));

    swimmer.give(orderFor(species, Manoeuvre::ForwardMedium));
    const double beatSeconds = 1 / species.swim.medium.beatHertz;
    const double beats = std::ceil(kSecondsToSteady / species.tissue.timeScale / beatSeconds);
    swimmer.advance(static_cast<int>(std::lround(beats * beatSeconds / swimmer.stepSeconds())));

    Trace trace{pointOf(swimmer.state().positions)};
    for (const auto& [order, ticks] : orders) {
        swimmer.give(order);
        for (int tick = 0; tick < ticks; ++tick) {
            swimmer.advance(stepsPerTick);
            trace.push_back(pointOf(swimmer.state().positions));
        }
    }
    return trace;
}

Trace traceFish(const Species& species, const Script& script) {
    std::vector<TimedOrder> orders;
    for (const Command& command : script)
        orders.push_back({orderFor(species, command.manoeuvre), command.ticks});
    return traceFish(species, orders);
}

}  // namespace aquarama
