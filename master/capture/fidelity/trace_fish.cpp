// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "common/units/ids.h"
#include "master/capture/fidelity/trace.h"

namespace aquarama::fidelity {

namespace {

constexpr double kSecondsToSteady = 24;  // the fish's own

// Who swims also keeps level and upright, as the replica always does (the paper's section 4.2); a
// fish that is both needs no fins for it.
capture::Order orderFor(const config::Species& species, Manoeuvre manoeuvre) {
    const config::Swim& swim = species.swim;
    switch (manoeuvre) {
        case Manoeuvre::ForwardSlow:
            return {.controller = capture::Controller::Balance, .gait = swim.slow};
        case Manoeuvre::ForwardMedium:
        case Manoeuvre::Balance:
            return {.controller = capture::Controller::Balance, .gait = swim.medium};
        case Manoeuvre::ForwardFast:
            return {.controller = capture::Controller::Balance, .gait = swim.fast};
        case Manoeuvre::TurnLeftGradual:
            return {.controller = capture::Controller::LeftTurn, .bend = species.turn.gradual};
        case Manoeuvre::TurnLeftSharp:
            return {.controller = capture::Controller::LeftTurn, .bend = species.turn.sharp};
        case Manoeuvre::TurnRightGradual:
            return {.controller = capture::Controller::RightTurn, .bend = species.turn.gradual};
        case Manoeuvre::TurnRightSharp:
            return {.controller = capture::Controller::RightTurn, .bend = species.turn.sharp};
        case Manoeuvre::Glide:
            return {.controller = capture::Controller::Glide};
        case Manoeuvre::Ascend:
            return {.controller = capture::Controller::Ascend,
                    .gait = swim.medium,
                    .pitchRadians = kScriptPitchRadians};
        case Manoeuvre::Descend:
            return {.controller = capture::Controller::Descend,
                    .gait = swim.medium,
                    .pitchRadians = kScriptPitchRadians};
        case Manoeuvre::Brake:
            return {.controller = capture::Controller::Brake};
        case Manoeuvre::Retreat:
            return {.controller = capture::Controller::Retreat, .gait = swim.slow};
    }
    return {};
}

TracePoint pointOf(const capture::NodeVectors& pose) {
    return {capture::frameOf(pose), capture::inBodyFrame(pose)};
}

}  // namespace

Trace traceFish(const config::Species& species, std::span<const TimedOrder> orders) {
    const double longest = capture::longestStepSeconds(capture::makeBiomechanicalFish(species));
    const int stepsPerTick = static_cast<int>(std::ceil(1 / (kTicksPerSecond * longest) - 1e-9));
    capture::Swimmer swimmer(species, 1 / (kTicksPerSecond * stepsPerTick));

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

Trace traceFish(const config::Species& species, const Script& script) {
    std::vector<TimedOrder> orders;
    for (const ScriptCommand& command : script)
        orders.push_back({orderFor(species, command.manoeuvre), command.ticks});
    return traceFish(species, orders);
}

}  // namespace aquarama::fidelity
