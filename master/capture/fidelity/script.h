// SPDX-License-Identifier: Apache-2.0
// What a mind might command for a minute: the same for the biomechanical fish and for its replica.
#pragma once

#include <cstdint>
#include <vector>

#include "common/motion/repertoire.h"

namespace aquarama::fidelity {

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

}  // namespace aquarama::fidelity
