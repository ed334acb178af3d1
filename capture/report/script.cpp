// SPDX-License-Identifier: Apache-2.0
#include "capture/report/script.h"

#include <array>
#include <cassert>
#include <cmath>
#include <random>
#include <span>

#include "common/base/units.h"

namespace aquarama::report {

namespace {

constexpr int kRunInBeats = 6;

// What may follow a command: a Markov chain. Weights are relative within a table.
struct Choice {
    Manoeuvre manoeuvre;
    std::uint64_t weight;
};
// After medium swimming more than half of the commands are turns.
constexpr std::array kAfterMedium{Choice{Manoeuvre::ForwardSlow, 12},
                                  Choice{Manoeuvre::ForwardFast, 12},
                                  Choice{Manoeuvre::TurnLeftGradual, 15},
                                  Choice{Manoeuvre::TurnRightGradual, 15},
                                  Choice{Manoeuvre::TurnLeftSharp, 12},
                                  Choice{Manoeuvre::TurnRightSharp, 12},
                                  Choice{Manoeuvre::Glide, 10},
                                  Choice{Manoeuvre::Ascend, 4},
                                  Choice{Manoeuvre::Descend, 4},
                                  Choice{Manoeuvre::Brake, 4},
                                  Choice{Manoeuvre::Retreat, 4},
                                  Choice{Manoeuvre::StartLeftSmall, 2},
                                  Choice{Manoeuvre::StartLeftMiddle, 2},
                                  Choice{Manoeuvre::StartLeftLarge, 2},
                                  Choice{Manoeuvre::StartRightSmall, 2},
                                  Choice{Manoeuvre::StartRightMiddle, 2},
                                  Choice{Manoeuvre::StartRightLarge, 2}};
constexpr std::array kAfterSlow{Choice{Manoeuvre::ForwardMedium, 7},
                                Choice{Manoeuvre::ForwardFast, 2},
                                Choice{Manoeuvre::Glide, 1},
                                Choice{Manoeuvre::StartLeftMiddle, 1},
                                Choice{Manoeuvre::StartRightLarge, 1}};
constexpr std::array kAfterStart{Choice{Manoeuvre::ForwardFast, 1}};
constexpr std::array kAfterFast{Choice{Manoeuvre::ForwardMedium, 7},
                                Choice{Manoeuvre::ForwardSlow, 2},
                                Choice{Manoeuvre::Glide, 1}};
constexpr std::array kAfterSlope{Choice{Manoeuvre::Balance, 1}};
constexpr std::array kAfterOthers{Choice{Manoeuvre::ForwardMedium, 8},
                                  Choice{Manoeuvre::ForwardSlow, 1},
                                  Choice{Manoeuvre::ForwardFast, 1}};

// Every other command, turns included, is followed by one of the gaits.
std::span<const Choice> choicesAfter(Manoeuvre manoeuvre) {
    switch (manoeuvre) {
        case Manoeuvre::ForwardMedium:
            return kAfterMedium;
        case Manoeuvre::ForwardSlow:
            return kAfterSlow;
        case Manoeuvre::ForwardFast:
            return kAfterFast;
        case Manoeuvre::Ascend:
        case Manoeuvre::Descend:
            return kAfterSlope;
        case Manoeuvre::StartLeftSmall:
        case Manoeuvre::StartLeftMiddle:
        case Manoeuvre::StartLeftLarge:
        case Manoeuvre::StartRightSmall:
        case Manoeuvre::StartRightMiddle:
        case Manoeuvre::StartRightLarge:
            return kAfterStart;
        default:
            return kAfterOthers;
    }
}

using Random = std::mt19937_64;

// A random choice by weight. The remainder instead of a library distribution: the same script with
// every standard library.
Manoeuvre choose(std::span<const Choice> choices, Random& random) {
    std::uint64_t sum = 0;
    for (const Choice& choice : choices) sum += choice.weight;
    assert(sum > 0);
    std::uint64_t left = random() % sum;
    for (const Choice& choice : choices) {
        if (left < choice.weight) return choice.manoeuvre;
        left -= choice.weight;
    }
    return choices.back().manoeuvre;
}

const motion::ActionSegment& segmentOf(const motion::Repertoire& repertoire, Manoeuvre manoeuvre) {
    return repertoire.segments.at(indexOf(actionOf(manoeuvre)));
}

// One cycle, in ticks, with its fraction.
double ticksOf(const motion::ActionSegment& segment) {
    return static_cast<double>(segment.periodSeconds) * kTicksPerSecond;
}

// How long a command lasts, in beats: a random length between the two.
struct Beats {
    double least, most;
};
// A balance is long enough for the fish to become level; a brake ends when it is nearly at rest. In
// three beats rowing fins would pitch some fish upright.
Beats beatsOf(Manoeuvre manoeuvre) {
    switch (manoeuvre) {
        case Manoeuvre::Brake:
        case Manoeuvre::PitchUp:
            return {1, 2};
        case Manoeuvre::Glide:
        case Manoeuvre::Retreat:
            return {2, 4};
        case Manoeuvre::Balance:
            return {6, 9};
        default:
            return {3, 7};
    }
}

double beatTicks(const motion::Repertoire& repertoire, Manoeuvre manoeuvre) {
    const bool hasItsOwn = manoeuvre <= Manoeuvre::ForwardFast;
    return ticksOf(segmentOf(repertoire, hasItsOwn ? manoeuvre : Manoeuvre::ForwardMedium));
}

// Draws one random number unless the manoeuvre is a turn.
ScriptCommand commandFor(const motion::Repertoire& repertoire,
                         Manoeuvre manoeuvre,
                         Random& random) {
    ScriptCommand command = briefest(repertoire, manoeuvre);
    if (playsToEnd(manoeuvre)) return command;
    constexpr double kUnit = 1.0 / 4294967296.0;  // 2^-32: the share is in [0, 1)
    const double share = static_cast<double>(random() >> 32U) * kUnit;
    const auto [least, most] = beatsOf(manoeuvre);
    command.ticks =
        static_cast<int>(std::ceil((least + share * (most - least)) * command.beatTicks));
    return command;
}

}  // namespace

const char* nameOf(Manoeuvre manoeuvre) {
    switch (manoeuvre) {
        case Manoeuvre::Ascend:
            return "ascend";
        case Manoeuvre::Descend:
            return "descend";
        case Manoeuvre::Balance:
            return "balance";
        case Manoeuvre::Brake:
            return "brake";
        default:
            return motion::nameOf(actionOf(manoeuvre));
    }
}

motion::Action actionOf(Manoeuvre manoeuvre) {
    using motion::Action;
    switch (manoeuvre) {
        case Manoeuvre::ForwardSlow:
            return Action::ForwardSlow;
        case Manoeuvre::ForwardMedium:
        case Manoeuvre::Ascend:
        case Manoeuvre::Descend:
        case Manoeuvre::Balance:
            return Action::ForwardMedium;
        case Manoeuvre::ForwardFast:
            return Action::ForwardFast;
        case Manoeuvre::TurnLeftGradual:
            return Action::TurnLeftGradual;
        case Manoeuvre::TurnLeftSharp:
            return Action::TurnLeftSharp;
        case Manoeuvre::TurnRightGradual:
            return Action::TurnRightGradual;
        case Manoeuvre::TurnRightSharp:
            return Action::TurnRightSharp;
        case Manoeuvre::Glide:
        case Manoeuvre::Brake:
            return Action::Glide;
        case Manoeuvre::Retreat:
            return Action::Retreat;
        case Manoeuvre::CurveLeft:
            return Action::CurveLeftTightMedium;
        case Manoeuvre::CurveRight:
            return Action::CurveRightTightMedium;
        case Manoeuvre::Hover:
            return Action::Hover;
        case Manoeuvre::PivotLeft:
            return Action::PivotLeft;
        case Manoeuvre::PitchUp:
            return Action::PitchUp;
        case Manoeuvre::StartLeftSmall:
        case Manoeuvre::StartLeftMiddle:
        case Manoeuvre::StartLeftLarge:
        case Manoeuvre::StartRightSmall:
        case Manoeuvre::StartRightMiddle:
        case Manoeuvre::StartRightLarge:
            return static_cast<Action>(indexOf(Action::StartLeftSmall) +
                                       (static_cast<std::size_t>(manoeuvre) -
                                        static_cast<std::size_t>(Manoeuvre::StartLeftSmall)));
    }
    return Action::ForwardMedium;
}

ScriptCommand runIn(const motion::Repertoire& repertoire) {
    const double beat = beatTicks(repertoire, Manoeuvre::ForwardMedium);
    assert(beat > 0);  // else a script would never be long enough
    return {Manoeuvre::ForwardMedium, static_cast<int>(std::ceil(kRunInBeats * beat)), beat};
}

ScriptCommand briefest(const motion::Repertoire& repertoire, Manoeuvre manoeuvre) {
    ScriptCommand command{.manoeuvre = manoeuvre, .beatTicks = beatTicks(repertoire, manoeuvre)};
    if (playsToEnd(manoeuvre)) {
        const long rate = std::lround(65536 / ticksOf(segmentOf(repertoire, manoeuvre)));
        const long last = motion::lastPhaseOf(actionOf(manoeuvre));
        command.ticks = static_cast<int>(last / rate);
    } else {
        command.ticks = static_cast<int>(std::ceil(beatsOf(manoeuvre).least * command.beatTicks));
    }
    return command;
}

Script makeScript(const motion::Repertoire& repertoire, std::uint64_t seed, double seconds) {
    Random random(seed);
    // The run-in, then each command by what came before it.
    Script script{runIn(repertoire)};
    while (ticksOf(script) < seconds * kTicksPerSecond)
        script.push_back(
            commandFor(repertoire, choose(choicesAfter(script.back().manoeuvre), random), random));
    return script;
}

int ticksOf(const Script& script) {
    int ticks = 0;
    for (std::size_t i = 1; i < script.size(); ++i) ticks += script[i].ticks;
    return ticks;
}

}  // namespace aquarama::report
