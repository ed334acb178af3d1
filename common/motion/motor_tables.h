// SPDX-License-Identifier: Apache-2.0
// The tables that the motor step reads, how they are made from a repertoire, and the part of the
// step that both versions share. Tables are computed in doubles and without libm, so they are the
// same on every machine.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"
#include "common/motion/warp_plans.h"

namespace aquarama::motion {

// Sample k is at phase k / kPhases of a cycle.
inline constexpr std::size_t kPathSamples = 2 * kPhases + 1;
inline constexpr std::size_t kCycleSamples = kPhases + 1;  // the last repeats the first

// How the cycle-mean frame moves at a phase, in its own axes and in 1/64 of a cycle.
struct MeanMotion {
    glm::dvec3 halfTurn{};  // tangent of half the angle, along the axis
    double forward = 0.0;   // body lengths
};

// The path of the body frame over a segment.
struct GaitPath {
    // The body frame at phase k as seen from phase 0, over two cycles: a tick across the end of a
    // cycle then needs no special case.
    std::array<glm::dquat, kPathSamples> rotation{};
    std::array<glm::dvec3, kPathSamples> translation{};  // body lengths
    // Rotation from the cycle-mean frame to body axes. The tail beat does not sway the mean frame:
    // its x axis lies along the path, from which the body of a fish on a curve or slope deviates.
    std::array<glm::dquat, kCycleSamples> bodyFromMean{};
    std::array<MeanMotion, kCycleSamples> mean{};
};

// Integrates the increments of a segment and takes the mean over one cycle around each phase.
[[nodiscard]] GaitPath pathOf(const ActionSegment& segment);
// The same of a turn or a fast start. Its speeds at the ends are those of TurnPath.
[[nodiscard]] GaitPath pathOf(const TurnPath& turn, float periodSeconds, bool isStart);

// The motor step's tables of a species: about 1.9 MB, of which a steady school reads 36 kB. So the
// segments that are played stay in the processor's cache. The poses, 0.9 MB, are read where nodal
// points are asked for.

// The body frame at a phase as seen from phase 0, in body lengths; and the speed of the path there:
// speed units for each unit of phase rate. For a swimming segment that is the mean over the cycle
// at every phase.
struct alignas(32) PathSample {
    Quaternion rotation;
    std::array<float, 4> translationAndSpeed{};
};

// The tables of one segment. bodyFromMean has one sample more than a cycle, so interpolation never
// wraps around.
struct SegmentTables {
    std::array<PathSample, kPathSamples> path;
    std::array<Quaternion, kCycleSamples> bodyFromMean;
    // Half the mean frame's turn, in its own axes, radians for each unit of phase rate in a tick:
    // the mean over a cycle, zero for a turn and the glide. A fish turns so while it warps to a
    // curve.
    std::array<float, 3> meanHalfTurn{};
    // As recorded: body lengths a second; radians a second, left positive; 1/65536 of a cycle in a
    // tick.
    float speedBodyLengths = 0.0F;
    float turnRate = 0.0F;
    std::int16_t phaseRate = 0;
    bool playsToEnd = false;
    // The phase beyond which a segment that plays to its end is left. A fast start does not end as
    // it begins: it is left at its last sample.
    std::int32_t lastPhase = 0xFFFF;
};

// SpeedResponse in the motor's units: by how many speed units the speed changes in a tick.
struct SpeedLoss {
    // For each squared speed unit, while a segment plays; 1 where no response was measured, so that
    // the speed follows at once.
    std::array<float, kSegments> drag{};
    // The share of its speed that a fish loses with its fins fully spread.
    float brake = 0.0F;
};

// The nodal points of a sample and of the next one, as vectors read them: in 32 bits a coordinate
// of the first (the low half) and the same of the second, in units of kPoseUnit. Two groups of
// sixteen points, of each the x, the y and the z. The second group ends at the last point, and so
// repeats some of the first.
inline constexpr std::size_t kPointGroup = 16;
inline constexpr std::size_t kSecondGroup = body::kNodalPoints - kPointGroup;  // its first point
struct alignas(64) PointPairs {
    std::array<std::array<std::array<std::int32_t, kPointGroup>, 3>, 2> groups{};
};

// Facts of a segment in 32 bits: its action in the lowest 8; kPitchesInAddition; above, from bit
// kTurnRateBit on, its recorded phase rate if it plays to its end, else 0.
inline constexpr std::int32_t kActionOfFacts = 0xFF;
inline constexpr std::int32_t kPitchesInAddition = 0x100;  // MotorTables::pitchRate is not 0
inline constexpr int kTurnRateBit = 16;

// All tables of a species. Made by makeMotorTables(), read by every thread of the world.
class MotorTables {
  public:
    std::array<SegmentTables, kSegments> segments;
    WarpPlans warps;
    // Whether the pectoral fins row in an action.
    std::array<bool, kActions> rows{};
    // The facts of a segment, which the vectorised step gathers at once: factsOf().
    std::array<std::int32_t, kSegments> facts{};
    // The speeds, in speed units, half-way between those at which turns and fast starts were
    // entered.
    std::array<std::int32_t, kEntrySpeeds - 1> turnBorders{};
    std::array<std::int32_t, kStartSpeeds - 1> startBorders{};
    SpeedLoss loss;
    // The most that a fish pitches in addition to the played motion, radians in a tick: kAddedPitch
    // of what it does on the captured loop at the medium gait; nothing on a slope or in its place.
    std::array<float, kSegments> pitchRate{};
    // The deformation d of eq. 12 by action and sample; after the last sample comes the first.
    std::array<std::array<PointPairs, kPhases>, kActions> poses{};
};

// The first part of a tick of one fish, before it steers: the segment that plays, and the travel of
// the body frame. Shared by the plain and the vectorised step; compiled once for each instruction
// set.

// Limits of a fish's own steering on top of the recorded motion, per tick of 1/60 s. With these
// gains it settles without a jerk; the rates are those of a real fish.
inline constexpr float kAddedPitch = 1.0F / 48.0F;  // of the rate of the loop
inline constexpr float kPitchGain = 0.05F;
inline constexpr float kSteepestPitch = 0.86602540F;  // sine of 60 degrees
inline constexpr float kRollGain = 0.05F;
inline constexpr float kRollRate = 0.013089969F;        // 45 degrees a second
inline constexpr float kNoseVerticalSquared = 0.0025F;  // sine of 3 degrees: no roll to measure
inline constexpr float kPitchUnit = 1.0F / 32768.0F;    // of MotorCommands::pitch
inline constexpr float kUnitsPerMillimetre = 65.536F;   // position
inline constexpr float kLongestStepUnits = 4194304.0F;  // 2^22, 64 m: rounds exactly up to there
// 2^-10, added to the level axis: a fish whose nose is exactly vertical has none of its own, and
// pitches about this one.
inline constexpr float kLevelAxisBias = 0.0009765625F;
// 2^-24: keeps a squared length off zero before its inverse root.
inline constexpr float kTiniest = 5.9604645e-08F;
// First guess of the inverse square root from the bits of a float: the constant of Quake III Arena,
// analysed by Lomont 2003.
inline constexpr std::uint32_t kInverseRootGuess = 0x5F3759DFU;
inline constexpr float kFastest = 4194303.0F;       // kFastestUnits
inline constexpr float kBrakeUnit = 1.0F / 255.0F;  // of MotorCommands::brake
// Body lengths in a tick for each speed unit.
inline constexpr float kLengthsPerSpeedUnit =
    1.0F / (kSpeedUnitsPerBodyLength * static_cast<float>(kTicksPerSecond));

// A range is stepped in whole vectors of this many fish on every machine; the rest is stepped by
// the plain version.
inline constexpr std::size_t kWidestLanes = 16;

// The columns of the states and commands, as plain pointers: their stores alias nothing.
struct MotorColumns {
    const std::uint8_t* wanted;
    const std::int16_t* phaseRate;
    const std::int32_t* speed;
    std::uint16_t *phase, *fromPhase, *segment, *fromSegment;
    std::uint8_t *warpFrame, *warpLength;
};

// Pointers to the columns, valid until one is resized.
[[nodiscard]] inline MotorColumns columnsOf(const MotorCommands& commands, MotionStates& states) {
    return {commands.action.data(),
            commands.phaseRate.data(),
            states.speed.data(),
            states.phase.data(),
            states.fromPhase.data(),
            states.segment.data(),
            states.fromSegment.data(),
            states.warpFrame.data(),
            states.warpLength.data()};
}

// One tick's travel along the recorded path. start and end are the body frame at the tick's ends,
// both as seen from one frame that the fish carries along: phase 0 of the path, or in a warp the
// mean frame at the tick's start.
struct Travel {
    PathSample start, end;
    Quaternion bodyFromMean;  // at the end
    // The phase rate that the path's speeds are multiplied by.
    std::int32_t rate = 0;
};

// Interpolates component by component, not normalised.
[[nodiscard]] inline Quaternion lerp(const Quaternion& a, const Quaternion& b, float share) {
    return {a.w + share * (b.w - a.w),
            a.x + share * (b.x - a.x),
            a.y + share * (b.y - a.y),
            a.z + share * (b.z - a.z)};
}

// Interpolates rotation, translation and speed.
[[nodiscard]] inline PathSample lerp(const PathSample& a, const PathSample& b, float share) {
    PathSample at{.rotation = lerp(a.rotation, b.rotation, share)};
    for (std::size_t i = 0; i < at.translationAndSpeed.size(); ++i) {
        const float here = a.translationAndSpeed[i];
        at.translationAndSpeed[i] = here + share * (b.translationAndSpeed[i] - here);
    }
    return at;
}

// The place of a phase within its cell, [0, 1).
[[nodiscard]] inline float fractionOf(std::uint32_t phase) {
    return static_cast<float>(phase & 1023U) * kPhaseCellUnit;
}

// The segment of a turn or a fast start for fish i: the one that was captured at the nearest speed
// and phase of the beat, or out of a glide where the fish does not beat its tail.
[[nodiscard]] inline std::uint16_t entryOf(const MotorTables& tables,
                                           const MotorColumns& fish,
                                           std::size_t i,
                                           Action turn) {
    if (!swims(actionOf(fish.segment[i]))) return firstSegmentOf(turn);
    std::size_t entry = 0;
    const auto passes = [&](std::span<const std::int32_t> borders) {
        for (const std::int32_t border : borders)
            entry += fish.speed[i] > border ? kEntryPhases : 0;
    };
    isStart(turn) ? passes(tables.startBorders) : passes(tables.turnBorders);
    constexpr std::uint32_t kStep = 65536 / kEntryPhases;
    entry += (fish.phase[i] + kStep / 2) / kStep % kEntryPhases;
    return static_cast<std::uint16_t>(firstSegmentOf(turn) + 1 + entry);
}

// Leaves the segment of fish i for the commanded one, by the plan for its phase cell.
inline void startWarp(const MotorTables& tables, const MotorColumns& fish, std::size_t i) {
    const auto next = static_cast<Action>(fish.wanted[i]);
    const std::size_t action = indexOf(actionOf(fish.segment[i]));
    const WarpPlan plan = tables.warps[action][fish.phase[i] >> kPhaseCellBits][indexOf(next)];
    const std::uint16_t segment =
        entriesOf(next) > 0 ? entryOf(tables, fish, i, next) : firstSegmentOf(next);
    fish.fromSegment[i] = fish.segment[i];
    fish.fromPhase[i] = fish.phase[i];
    fish.segment[i] = segment;
    fish.phase[i] = plan.entryPhase;
    fish.warpFrame[i] = 0;
    fish.warpLength[i] = plan.frames;
}

// The motion of a fish in a tick: it warps, or plays its segment between two phases of the
// two-cycle path (1/65536 of a cycle).
struct Playing {
    bool warps = true;
    std::int32_t from = 0, to = 0;
};

// Advances segment, phase and warp counter of fish i by a tick. The commanded rate is that of the
// commanded action: while a turn plays that is no longer commanded, it plays as recorded. A turn or
// a fast start is left at its end, and by a warp even if the same follows, or where it is broken
// off; every other segment is left at once. A command for an action that does not exist starts no
// warp.
[[nodiscard]] inline Playing advanceSegment(const MotorTables& tables,
                                            const MotorColumns& fish,
                                            std::size_t i) {
    if (fish.warpFrame[i] != fish.warpLength[i]) {
        ++fish.warpFrame[i];
        return {};
    }
    const SegmentTables& playing = tables.segments[fish.segment[i]];
    const Action action = actionOf(fish.segment[i]);
    const auto wanted = static_cast<Action>(fish.wanted[i]);
    const bool leaves = wanted != action;
    const std::int32_t phase = fish.phase[i];
    const std::int32_t rate = leaves ? playing.phaseRate : fish.phaseRate[i];
    const bool mayEnter = fish.wanted[i] < kActions;
    const bool ends = phase + rate > playing.lastPhase || breaksOff(action, wanted);
    if (mayEnter && (playing.playsToEnd ? ends : leaves)) {
        startWarp(tables, fish, i);
        return {};
    }
    fish.phase[i] = static_cast<std::uint16_t>(phase + rate);
    return {.warps = false, .from = phase, .to = phase + rate};
}

// The rotation from the mean frame to the body frame at a phase.
[[nodiscard]] inline Quaternion swayAt(const SegmentTables& tables, std::uint32_t phase) {
    const std::size_t cell = phase >> kPhaseCellBits;
    return lerp(tables.bodyFromMean[cell], tables.bodyFromMean[cell + 1], fractionOf(phase));
}

// The path's speed in whole speed units, at a phase rate.
[[nodiscard]] inline float pathSpeed(float perRate, float rate) {
    return roundToEven(std::min(std::max(perRate * rate, -kFastest), kFastest));
}

// v + 2w (u x v) + 2 u x (u x v), with u the vector part of q.
using Vector = std::array<float, 3>;
[[nodiscard]] inline Vector rotated(const Quaternion& q, const Vector& v) {
    const float x = 2.0F * (q.y * v[2] - q.z * v[1]);
    const float y = 2.0F * (q.z * v[0] - q.x * v[2]);
    const float z = 2.0F * (q.x * v[1] - q.y * v[0]);
    return {(v[0] + q.w * x) + (q.y * z - q.z * y),
            (v[1] + q.w * y) + (q.z * x - q.x * z),
            (v[2] + q.w * z) + (q.x * y - q.y * x)};
}

// The arithmetic of a warp, on the four numbers of a quaternion at a time: operation for operation
// that of Quaternion, so the bits are the same.
using Four = float __attribute__((vector_size(16)));  // w, x, y, z

// The four numbers of a quaternion.
[[nodiscard]] inline Four four(const Quaternion& q) {
    return Four{q.w, q.x, q.y, q.z};
}
// The reverse.
[[nodiscard]] inline Quaternion quaternion(const Four& q) {
    return {q[0], q[1], q[2], q[3]};
}
// The inverse of a unit quaternion.
[[nodiscard]] inline Four conjugate(const Four& q) {
    return q * Four{1.0F, -1.0F, -1.0F, -1.0F};
}
// Interpolated number by number, not normalised.
[[nodiscard]] inline Four lerp(const Four& a, const Four& b, float share) {
    return a + share * (b - a);
}
// Of unit length; q must not be zero.
[[nodiscard]] inline Four normalised(const Four& q) {
    const Four squared = q * q;
    return q * (1.0F / std::sqrt((squared[0] + squared[1]) + (squared[2] + squared[3])));
}
// Rotates by b first.
[[nodiscard]] inline Four product(const Four& a, const Four& b) {
    constexpr Four kLessW{-1.0F, 1.0F, 1.0F, 1.0F};
    const Four first = __builtin_shufflevector(a, a, 0, 0, 0, 0) * b;
    const Four second =
        __builtin_shufflevector(a, a, 1, 1, 2, 3) * __builtin_shufflevector(b, b, 1, 0, 0, 0);
    const Four third =
        __builtin_shufflevector(a, a, 2, 2, 3, 1) * __builtin_shufflevector(b, b, 2, 3, 1, 2);
    const Four fourth =
        __builtin_shufflevector(a, a, 3, 3, 1, 2) * __builtin_shufflevector(b, b, 3, 2, 3, 1);
    return (first + kLessW * second) + (kLessW * third - fourth);
}
// swayAt() as four numbers.
[[nodiscard]] inline Four swayOfCell(const SegmentTables& tables, std::uint32_t phase) {
    const Quaternion* const cell = &tables.bodyFromMean[phase >> kPhaseCellBits];
    return lerp(four(cell[0]), four(cell[1]), fractionOf(phase));
}

// Motion of the mean frame in a tick, in its frame at the start; units as in PathSample.
struct MeanTravel {
    Four turn{};
    Vector way{};
    float speedAtStart = 0.0F, speedAtEnd = 0.0F;
    std::int32_t rate = 0;
};

// Whether a fish that warps from one action to another coasts meanwhile: a tail that was still, as
// in a gait of the fins, has to form its wave.
[[nodiscard]] inline bool coastsBetween(const MotorTables& tables, Action from, Action to) {
    if (!swims(to)) return false;
    if (from == Action::Glide || staysInPlace(from)) return true;
    return swims(from) && tables.rows[indexOf(from)] && !tables.rows[indexOf(to)];
}

// The travel in a warp to a cycle: that of its mean. (The paper does not say what the body frame
// does during a warp; if it were frozen, the fish would halt.)
[[nodiscard]] inline MeanTravel cyclingTravel(const SegmentTables& next,
                                              std::uint32_t phase,
                                              std::int32_t rate) {
    const auto played = static_cast<float>(rate);
    const auto& [x, y, z] = next.meanHalfTurn;
    const float speed = next.path[phase >> kPhaseCellBits].translationAndSpeed[3];
    const float way = pathSpeed(speed, played) * kLengthsPerSpeedUnit;
    return {.turn = normalised(Four{1.0F, x * played, y * played, z * played}),
            .way = {way, 0.0F, 0.0F},
            .speedAtStart = speed,
            .speedAtEnd = speed,
            .rate = rate};
}

// The travel in a warp to a turn: that of the turn between two of its phases. The turn plays from
// the first frame of the warp on, which ends at the phase that the turn then has.
[[nodiscard]] inline MeanTravel turningTravel(const SegmentTables& turn,
                                              std::uint32_t from,
                                              std::uint32_t to) {
    const auto rotationAt = [&](std::uint32_t phase) {
        const PathSample* cell = &turn.path[phase >> kPhaseCellBits];
        return lerp(four(cell[0].rotation), four(cell[1].rotation), fractionOf(phase));
    };
    const auto placeAt = [&](std::uint32_t phase) {
        const PathSample* cell = &turn.path[phase >> kPhaseCellBits];
        const auto numbers = [](const PathSample& sample) {
            const auto& [x, y, z, speed] = sample.translationAndSpeed;
            return Four{x, y, z, speed};
        };
        return lerp(numbers(cell[0]), numbers(cell[1]), fractionOf(phase));
    };
    const Four fromStart = conjugate(normalised(product(rotationAt(from), swayOfCell(turn, from))));
    const Four a = placeAt(from);
    const Four b = placeAt(to);
    const Four way = b - a;
    return {.turn = normalised(product(fromStart, product(rotationAt(to), swayOfCell(turn, to)))),
            .way = rotated(quaternion(fromStart), {way[0], way[1], way[2]}),
            .speedAtStart = a[3],
            .speedAtEnd = b[3],
            .rate = static_cast<std::int32_t>(to - from)};
}

// A tick of a motion warp: the mean frame moves with the next segment, while the sway changes from
// that of the last pose to that of the first.
[[nodiscard]] inline Travel warpingTravel(const MotorTables& tables,
                                          const MotorColumns& fish,
                                          std::size_t i) {
    const SegmentTables& next = tables.segments[fish.segment[i]];
    const Four last = swayOfCell(tables.segments[fish.fromSegment[i]], fish.fromPhase[i]);
    const Four first = swayOfCell(next, fish.phase[i]);
    const std::uint32_t frame = fish.warpFrame[i];
    const std::uint32_t frames = fish.warpLength[i] + 1U;
    const float steps = 1.0F / static_cast<float>(frames);
    const auto swayAfter = [&](std::uint32_t done) {
        return normalised(lerp(last, first, static_cast<float>(done) * steps));
    };
    const bool coasts =
        coastsBetween(tables, actionOf(fish.fromSegment[i]), actionOf(fish.segment[i]));
    const auto turnsTo = [&](std::uint32_t done) { return fish.phase[i] * done / frames; };
    const MeanTravel mean =
        next.playsToEnd ? turningTravel(next, turnsTo(frame), turnsTo(frame + 1))
                        : cyclingTravel(next, fish.phase[i], coasts ? 0 : fish.phaseRate[i]);
    const Four sway = swayAfter(frame + 1);
    const auto& [x, y, z] = mean.way;
    return {
        .start = {quaternion(conjugate(swayAfter(frame))), {0.0F, 0.0F, 0.0F, mean.speedAtStart}},
        .end = {quaternion(product(mean.turn, conjugate(sway))), {x, y, z, mean.speedAtEnd}},
        .bodyFromMean = quaternion(sway),
        .rate = mean.rate};
}

}  // namespace aquarama::motion
