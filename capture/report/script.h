// SPDX-License-Identifier: Apache-2.0
// A script of random commands, such as a mind gives within a minute, and the traces of the fish
// that follow it: the biomechanical fish and its kinematic replica.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture/dynamics.h"
#include "capture/swimmer.h"
#include "common/body/fins.h"
#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// The manoeuvres that can be commanded. The replica swims level, climbs and dives on the captured
// slopes, and brakes in the glide with its fins spread. Curves are the tight ones at medium speed.
// Random scripts have none of these and nothing in one place; the film has (film_script.h).
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
    StartLeftSmall,
    StartLeftMiddle,
    StartLeftLarge,
    StartRightSmall,
    StartRightMiddle,
    StartRightLarge,
    CurveLeft,
    CurveRight,
    Hover,
    PivotLeft,
    PitchUp,
};
inline constexpr int kManoeuvres = 24;
// "forward_slow", ..., "ascend", ...; the string is static.
[[nodiscard]] const char* nameOf(Manoeuvre manoeuvre);
[[nodiscard]] constexpr bool isTurn(Manoeuvre m) {
    return m >= Manoeuvre::TurnLeftGradual && m <= Manoeuvre::TurnRightSharp;
}
[[nodiscard]] constexpr bool isStart(Manoeuvre m) {
    return m >= Manoeuvre::StartLeftSmall && m <= Manoeuvre::StartRightLarge;
}
[[nodiscard]] constexpr bool isCurve(Manoeuvre m) {
    return m == Manoeuvre::CurveLeft || m == Manoeuvre::CurveRight;
}
// Hovering, turning and pitching in one place. To the right and down they are the mirror image.
[[nodiscard]] constexpr bool staysInPlace(Manoeuvre m) {
    return m >= Manoeuvre::Hover;
}

// The action that the replica plays for a manoeuvre while its pitch is the wanted one.
[[nodiscard]] motion::Action actionOf(Manoeuvre manoeuvre);

// The pitch of Ascend and, downwards, of Descend: 20 degrees.
inline constexpr double kScriptPitchRadians = 0.35;

// One command to the fish and its replica.
struct ScriptCommand {
    Manoeuvre manoeuvre = Manoeuvre::ForwardMedium;
    int ticks = 0;         // how long it lasts
    double beatTicks = 0;  // period of a beat of the gait, or else of medium swimming
};
// The first command is the run-in, which is not measured.
using Script = std::vector<ScriptCommand>;

// Turns and fast starts last their segment.
[[nodiscard]] constexpr bool playsToEnd(Manoeuvre m) {
    return isTurn(m) || isStart(m);
}

// The run-in: steady swimming at medium speed.
[[nodiscard]] ScriptCommand runIn(const motion::Repertoire& repertoire);
// A command that lasts as short as a script has it: a turn or a fast start the whole ticks in which
// the motor plays its segment, everything else some beats.
[[nodiscard]] ScriptCommand briefest(const motion::Repertoire& repertoire, Manoeuvre manoeuvre);

// The run-in, then random commands until they last `seconds` or
// more; the last one is not cut. A gait lasts some of its beats. A turn follows medium swimming and
// lasts its segment; a fast start does too, or follows slow swimming or a brake, and fast swimming
// follows. After an ascent or a descent the fish balances. Brakes and retreats are rare. A pure
// function of its arguments.
[[nodiscard]] Script makeScript(const motion::Repertoire& repertoire,
                                std::uint64_t seed,
                                double seconds);

// The length of the script without its run-in.
[[nodiscard]] int ticksOf(const Script& script);

// What a fish did at one tick, in the same form for the biomechanical fish and its replica.
struct TracePoint {
    capture::PoseFrame frame;     // body frame in the world, body lengths
    capture::NodeVectors pose{};  // nodal points in the body frame, body lengths (eq. 8)
    body::FinDrive drive{};       // what moves its fins; the seconds are left to who draws
};

// The first point is before the first command, so there is one more than ticks.
using Trace = std::vector<TracePoint>;

// A command to the biomechanical fish and how long it holds.
struct TimedOrder {
    capture::Order order;
    int ticks = 0;
};

// The biomechanical fish follows the orders. Before the first point it has swum from rest at medium
// speed until it swims steadily, for a whole number of beats.
[[nodiscard]] Trace traceFish(const config::Species& species, std::span<const TimedOrder> orders);
[[nodiscard]] Trace traceFish(const config::Species& species, const Script& script);

// The replica follows the script. It starts at phase 0 of forward_medium, at that gait's speed.
[[nodiscard]] Trace traceReplica(const motion::Repertoire& repertoire, const Script& script);
// The same, but before each command the phase of a cyclic segment is set to the one whose pose is
// nearest to that of `fish`, with the course unchanged: so each command begins alike for both.
// `fish` is the trace of the biomechanical fish under the same script.
[[nodiscard]] Trace traceReplicaInPhase(const motion::Repertoire& repertoire,
                                        const Script& script,
                                        const Trace& fish);

// Traces of one script, all of the same length.
struct Traces {
    Trace fish;
    Trace replica;       // traceReplicaInPhase()
    Trace looseReplica;  // traceReplica(): not corrected at any command
};
[[nodiscard]] Traces traceBoth(const config::Species& species,
                               const motion::Repertoire& repertoire,
                               const Script& script);

}  // namespace aquarama::report
