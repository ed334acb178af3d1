// SPDX-License-Identifier: Apache-2.0
// The action repertoire of a species, and its file.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::motion {

// The action repertoire of a species: one cycle of each action, captured from the biomechanical
// fish (paper, section 3).

// Samples of one cycle; phase k is at k / 64 of the period.
inline constexpr int kPhases = 64;

// The actions that a fish can be told to do. Files and the wire contain the numbers. Each gait
// swims straight on, on four curves and on two slopes.
enum class Action : std::uint8_t {
    ForwardSlow,
    ForwardMedium,
    ForwardFast,
    CurveLeftWideSlow,
    CurveLeftWideMedium,
    CurveLeftWideFast,
    CurveLeftTightSlow,
    CurveLeftTightMedium,
    CurveLeftTightFast,
    CurveRightWideSlow,
    CurveRightWideMedium,
    CurveRightWideFast,
    CurveRightTightSlow,
    CurveRightTightMedium,
    CurveRightTightFast,
    ClimbSlow,
    ClimbMedium,
    ClimbFast,
    DiveSlow,
    DiveMedium,
    DiveFast,
    Retreat,
    Hover,
    PivotLeft,
    PivotRight,
    PitchUp,
    PitchDown,
    TurnLeftGradual,
    TurnLeftSharp,
    TurnRightGradual,
    TurnRightSharp,
    StartLeftSmall,
    StartLeftMiddle,
    StartLeftLarge,
    StartRightSmall,
    StartRightMiddle,
    StartRightLarge,
    Glide,
};
// All but the last are captured; the first kForwardGaits of them are gaits.
inline constexpr int kCapturedActions = 37;
inline constexpr int kActions = 38;
inline constexpr int kForwardGaits = 3;
// The first kSwimmingActions swim, by tail or fins: a gait straight on, on a curve or on a slope.
// Action a of them is of gait a % kForwardGaits.
inline constexpr int kSwimmingActions = 21;
[[nodiscard]] const char* nameOf(Action action);  // "forward_slow", ...

// The action as an index of arrays of kActions.
[[nodiscard]] constexpr std::size_t indexOf(Action action) {
    return static_cast<std::size_t>(action);
}
// Straight on, on a curve or on a slope.
[[nodiscard]] constexpr bool swims(Action action) {
    return action < Action::Retreat;
}
// Done by the pectoral fins in one place: hovering, turning and pitching there.
[[nodiscard]] constexpr bool staysInPlace(Action action) {
    return action >= Action::Hover && action <= Action::PitchDown;
}
[[nodiscard]] constexpr bool isPitch(Action action) {
    return action == Action::PitchUp || action == Action::PitchDown;
}
[[nodiscard]] constexpr bool isPivot(Action action) {
    return action == Action::PivotLeft || action == Action::PivotRight;
}
// Straight on.
[[nodiscard]] constexpr bool isForward(Action action) {
    return action <= Action::ForwardFast;
}
[[nodiscard]] constexpr bool isCurve(Action action) {
    return action >= Action::CurveLeftWideSlow && action <= Action::CurveRightTightFast;
}
[[nodiscard]] constexpr bool isSlope(Action action) {
    return action >= Action::ClimbSlow && action <= Action::DiveFast;
}
// Whether an action pitches the fish.
[[nodiscard]] constexpr bool pitches(Action action) {
    return isSlope(action) || isPitch(action);
}
// Turns and fast starts are played from their first phase to their last; the other actions are
// cycles.
[[nodiscard]] constexpr bool isTurn(Action action) {
    return action >= Action::TurnLeftGradual && action <= Action::TurnRightSharp;
}
[[nodiscard]] constexpr bool isStart(Action action) {
    return action >= Action::StartLeftSmall && action <= Action::StartRightLarge;
}
// Whether a turn or a fast start leads to the left.
[[nodiscard]] constexpr bool isLeft(Action turn) {
    return turn <= Action::TurnLeftSharp || (isStart(turn) && turn <= Action::StartLeftLarge);
}
[[nodiscard]] constexpr bool isSharp(Action action) {
    return action == Action::TurnLeftSharp || action == Action::TurnRightSharp;
}
// The gait of an action that swims; of a fast start the fast one, medium for every other.
[[nodiscard]] constexpr Action gaitOf(Action action) {
    if (swims(action)) return static_cast<Action>(indexOf(action) % kForwardGaits);
    return isStart(action) ? Action::ForwardFast : Action::ForwardMedium;
}
// Whether a turn under way is broken off for another action: for a fast start, and a sharp one for
// a sharp one to the other side. A fast start is never broken off.
[[nodiscard]] constexpr bool breaksOff(Action turn, Action wanted) {
    return (isTurn(turn) && isStart(wanted)) ||
           (isSharp(turn) && isSharp(wanted) && isLeft(wanted) != isLeft(turn));
}
// The gait of an action that swims, straight on, on a curve or on a slope; every other action
// itself.
[[nodiscard]] constexpr Action patternOf(Action action) {
    return swims(action) ? gaitOf(action) : action;
}
// A gait on the curve or slope of which `slow` is the action at the slow gait.
[[nodiscard]] constexpr Action atGait(Action slow, Action gait) {
    return static_cast<Action>(indexOf(slow) + indexOf(gait));
}

// A fish plays segments. An action has one, but a turn and a fast start have one for each entry
// beside: the first begins in the pose of a glide, the others in a tail beat, speed by speed and
// phase by phase. Their poses are the same, their paths differ. The numbers are part of the wire:
// those of the first actions, then those of the turns and of the fast starts, and last that of the
// glide.
inline constexpr int kEntryPhases = 8;  // of the beat, from 0 on, evenly spaced
inline constexpr int kEntrySpeeds = 5;  // of a turn: of the gaits, and half-way between them
inline constexpr int kTurnEntries = kEntrySpeeds * kEntryPhases;
inline constexpr int kTurnSegments = 1 + kTurnEntries;
inline constexpr int kTurns = 4;
inline constexpr int kStartSpeeds = 2;  // of a fast start: slow and medium
inline constexpr int kStartEntries = 1 + kStartSpeeds * kEntryPhases;
inline constexpr int kStartSegments = kStartEntries;
inline constexpr int kStarts = 6;
inline constexpr int kFirstTurn = static_cast<int>(Action::TurnLeftGradual);
inline constexpr int kFirstStart = static_cast<int>(Action::StartLeftSmall);
inline constexpr int kFirstStartSegment = kFirstTurn + kTurns * kTurnSegments;
inline constexpr int kSegments = kFirstStartSegment + kStarts * kStartSegments + 1;
// The paths by entry of an action. Those of a turn are beside that of its first segment; the first
// of a fast start is its first segment's, out of rest.
[[nodiscard]] constexpr int entriesOf(Action action) {
    return isTurn(action) ? kTurnEntries : isStart(action) ? kStartEntries : 0;
}
// The first segment of an action, and the action of a segment.
[[nodiscard]] constexpr std::uint16_t firstSegmentOf(Action action) {
    const int number = static_cast<int>(action);
    if (isTurn(action))
        return static_cast<std::uint16_t>(kFirstTurn + (number - kFirstTurn) * kTurnSegments);
    if (isStart(action))
        return static_cast<std::uint16_t>(kFirstStartSegment +
                                          (number - kFirstStart) * kStartSegments);
    return static_cast<std::uint16_t>(action == Action::Glide ? kSegments - 1 : number);
}
[[nodiscard]] constexpr Action actionOf(std::uint32_t segment) {
    const int number = static_cast<int>(segment);
    if (number < kFirstTurn) return static_cast<Action>(number);
    if (number < kFirstStartSegment)
        return static_cast<Action>(kFirstTurn + (number - kFirstTurn) / kTurnSegments);
    return static_cast<Action>(kFirstStart + (number - kFirstStartSegment) / kStartSegments);
}
static_assert(actionOf(kSegments - 1) == Action::Glide && kSegments <= 65536);

// The phase, 1/65536 of a cycle, beyond which a segment that plays to its end is left. A fast start
// does not end as it begins: it is left at its last sample.
[[nodiscard]] constexpr std::int32_t lastPhaseOf(Action action) {
    return isStart(action) ? (kPhases - 1) * (65536 / kPhases) : 0xFFFF;
}

// The change of the body frame from one phase to the next, in the body frame at its start: B' = B *
// increment (eq. 6 and 7, corrected: the rotation is one of the body frame, R' = R * rotation).
// Translation in body lengths.
struct FrameIncrement {
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 translation{};
};

// A position for each control point or nodal point, in units of kPoseUnit.
using ControlPointPose = std::array<std::array<std::int16_t, 3>, body::kControlPoints>;
using NodalPose = std::array<std::array<std::int16_t, 3>, body::kNodalPoints>;

// Poses are 16-bit: a position in the body frame, in body lengths, is component * kPoseUnit.
inline constexpr float kPoseUnit = 1.0F / 32767.0F;

// How the pectoral fins stand: opened, carried by the stroke, twisted; in units of kFinUnit
// (body::FinPose). Left, then right.
using FinAngles = std::array<std::int16_t, 3>;
using FinAnglePair = std::array<FinAngles, 2>;
inline constexpr float kFinUnit = 1e-4F;  // radians

// A frame increment for each phase.
using FrameIncrements = std::array<FrameIncrement, kPhases>;

// A turn or a fast start as begun in a tail beat. The courses are unit vectors in the body frame at
// its first and at its last phase; speeds are body lengths a second.
struct TurnPath {
    // Course and speed of the fish before it.
    glm::vec3 courseBefore{1, 0, 0};
    float speedBefore = 0.0F;
    // Course and speed after it: with these, a fish at the medium gait, after a fast start at the
    // fast one, arrives where the simulated one does.
    glm::vec3 courseAfter{1, 0, 0};
    float speedAfter = 0.0F;
    FrameIncrements increments{};
};

// One captured cycle of an action, as recorded from a fish of Repertoire::recordedLengthMetres.
struct ActionSegment {
    // Time of one cycle.
    float periodSeconds = 0.0F;
    // A turn or a fast start is entered at phase 0 and left at its end; all other segments
    // anywhere.
    bool playsToEnd = false;
    // From phase k to k + 1; the last leads to the end of the cycle. A turn or a fast start: from
    // the pose of a glide.
    FrameIncrements increments{};
    // The paths of a turn or a fast start by entry: entriesOf(), of a fast start first that out of
    // rest; then those begun in a tail beat, of the lowest speed first and each speed by the phase
    // of the beat. Or none, if they are all like `increments`.
    std::vector<TurnPath> entered;
    // Deformation d at phase k (eq. 8).
    std::array<NodalPose, kPhases> nodes{};
    // The pectoral fins at phase k.
    std::array<FinAnglePair, kPhases> fins{};
    // The surface s at phase k (eq. 9): kPhases poses, or none.
    std::vector<ControlPointPose> controlPoints;
};

// How the speed v of a fish follows that of what it plays, p, in body lengths and seconds:
//     dv/dt = swimDrag (|p| + e) (p - v)     while the tail beats: it meets the water at a speed
//                                            near p,
//     dv/dt = retreatDrag |p| (p - v)        in a retreat,
//     dv/dt = -glideDrag v |v|               in a glide or in one place: quadratic drag;
// where e is kExcessDrag max(v - p, 0): the drag of a body that is too fast grows with its speed;
// in all, fins that are spread to a share s also brake by s * brakeRate * v. (The paper leaves
// this open; the law is ours.)
inline constexpr float kExcessDrag = 0.25F;  // from changes of gait of all species
struct SpeedResponse {
    // 1 / body length. Turns have that of medium, fast starts that of fast. On a curve or slope the
    // gait's times (q / p)^2, where q is its speed straight on: the thrust is the same and the drag
    // of the body is more.
    std::array<float, kForwardGaits> swimDrag{};
    float retreatDrag = 0.0F;  // 1 / body length
    float glideDrag = 0.0F;    // 1 / body length
    float brakeRate = 0.0F;    // 1 / s
};

// All segments of a species, by Action. Read only once it is complete.
struct Repertoire {
    std::string species;
    float recordedLengthMetres = 0.0F;
    SpeedResponse response;
    std::vector<ActionSegment> segments{kActions};
};

// Fills in Action::Glide, which is not captured: the relaxed pose in which a gradual turn ends,
// straight on at the speed of forward_medium. Motion warps lead into it and out of it (paper,
// section 4.2).
void addGlide(Repertoire& repertoire);

// The file: "AQREP", version, length, species, speed response, captured segments, SHA-256 of all
// that precedes it; little-endian. Throws Error when a number is out of its bounds.
[[nodiscard]] std::vector<std::byte> encodeRepertoire(const Repertoire& repertoire);

// The reverse, with the glide added. Throws Error, naming `source`, when the bytes are truncated,
// altered, of another version or out of bounds. Sizes are checked before memory is allocated.
[[nodiscard]] Repertoire decodeRepertoire(std::span<const std::byte> bytes,
                                          const std::string& source);

// Where a presented phase lies between two samples of the cycle; the last is followed by the first.
struct PhaseSample {
    std::size_t before = 0, after = 0;
    float share = 0.0F;  // of `after`
};

// phase in cycles; one outside of [0, 1] is taken as the nearest end.
[[nodiscard]] inline PhaseSample sampleAt(float phase) {
    const float at = std::clamp(phase, 0.0F, 1.0F) * kPhases;
    const auto before = static_cast<std::size_t>(at);
    return {before % kPhases, (before + 1) % kPhases, at - static_cast<float>(before)};
}

// A number beyond the last action gives the last.
[[nodiscard]] inline const ActionSegment& segmentOf(const Repertoire& repertoire,
                                                    std::uint32_t action) {
    return repertoire.segments[std::min<std::size_t>(action, kActions - 1)];
}

}  // namespace aquarama::motion
