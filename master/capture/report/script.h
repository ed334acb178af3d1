// SPDX-License-Identifier: Apache-2.0
// What a mind might command for a minute: the same for the biomechanical fish and for its replica.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/dynamics.h"
#include "master/capture/swimmer.h"

namespace aquarama::report {

// The first eight are the actions of a repertoire, in their order; the others are made of them.
enum class Manoeuvre : std::uint8_t {
    ForwardSlow,
    ForwardMedium,
    ForwardFast,
    TurnLeftGradual,
    TurnLeftSharp,
    TurnRightGradual,
    TurnRightSharp,
    Glide,
    Ascend,
    Descend,
    Balance,
    Brake,
    Retreat,
};
inline constexpr int kManoeuvres = 13;
[[nodiscard]] const char* nameOf(Manoeuvre manoeuvre);
[[nodiscard]] constexpr bool isTurn(Manoeuvre m) {
    return m >= Manoeuvre::TurnLeftGradual && m <= Manoeuvre::TurnRightSharp;
}

// How steeply Ascend and Descend swim.
inline constexpr double kScriptPitchRadians = 0.35;

struct ScriptCommand {
    Manoeuvre manoeuvre = Manoeuvre::ForwardMedium;
    int ticks = 0;
    double beatTicks = 0;  // of the gait, or else of medium swimming
};
using Script = std::vector<ScriptCommand>;

// A run-in of steady swimming at medium speed, then commands until `seconds` of them are full; the
// last one ends as late as it must. Gaits last some of their beats, turns come out of medium
// swimming and last their segment, who has risen or sunk levels out, and the rest is rare. A pure
// function of its arguments.
[[nodiscard]] Script makeScript(const motion::Repertoire& repertoire,
                                std::uint64_t seed,
                                double seconds);

// Of the script without its run-in.
[[nodiscard]] int ticksOf(const Script& script);

// What a fish did, tick by tick: the common ground on which the biomechanical fish and its replica
// are compared.

struct TracePoint {
    capture::PoseFrame frame;     // in the world, body lengths
    capture::NodeVectors pose{};  // nodal points in the body frame, body lengths (eq. 8)
};

// One more than the ticks: the first is before the first command.
using Trace = std::vector<TracePoint>;

struct TimedOrder {
    capture::Order order;
    int ticks = 0;
};

// The biomechanical fish follows the script, after it has swum from rest at medium speed until it
// swims steadily and its beat begins anew.
[[nodiscard]] Trace traceFish(const config::Species& species, std::span<const TimedOrder> orders);
[[nodiscard]] Trace traceFish(const config::Species& species, const Script& script);

// The replica follows the script, from phase 0 of forward_medium and at its speed.
[[nodiscard]] Trace traceReplica(const motion::Repertoire& repertoire, const Script& script);
// The same, but where a command finds it swimming, its beat is first brought to the phase of the
// fish's, its course kept: so that each command begins alike for both.
[[nodiscard]] Trace traceReplicaInPhase(const motion::Repertoire& repertoire,
                                        const Script& script,
                                        const Trace& fish);

struct Traces {
    Trace fish;
    Trace replica;       // brought into phase at each command
    Trace looseReplica;  // left alone from the first command to the last
};
[[nodiscard]] Traces traceBoth(const config::Species& species,
                               const motion::Repertoire& repertoire,
                               const Script& script);

}  // namespace aquarama::report
