// SPDX-License-Identifier: Apache-2.0
// What a tick does to one fish before it steers: which segment plays, and where that takes the body
// frame. Shared by the plain and the vectorised step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/motion/motion_state.h"
#include "common/motion/motor_tables.h"

namespace aquarama {

// Limits of what a fish adds to the recorded motion, per tick of 1/60 s. The gains let it settle
// without a jerk; the rates keep it within what a fish does.
inline constexpr float kPitchGain = 0.1F;
inline constexpr float kPitchRate = 0.017453293F;     // 60 degrees a second
inline constexpr float kSteepestPitch = 0.86602540F;  // sine of 60 degrees
inline constexpr float kRollGain = 0.05F;
inline constexpr float kRollRate = 0.013089969F;        // 45 degrees a second
inline constexpr float kNoseVerticalSquared = 0.0025F;  // sine of 3 degrees: no roll to measure
inline constexpr float kPitchUnit = 1.0F / 32768.0F;    // of MotorCommands::pitch
inline constexpr float kYawUnit = 1.0F / 1048576.0F;    // of MotorCommands::yawRate, radians
inline constexpr float kUnitsPerMillimetre = 65.536F;   // position
inline constexpr float kLongestStepUnits = 4194304.0F;  // 2^22, 64 m: rounds exactly up to there
inline constexpr float kLevelAxisBias = 0.0009765625F;  // gives a vertical nose a way to fall
inline constexpr float kTiniest = 5.9604645e-08F;       // 2^-24: divides where nothing is left

// A range is stepped in whole vectors of this many fish on every machine, and what is left plainly.
inline constexpr std::size_t kWidestLanes = 16;

// The columns of the states and commands, as plain pointers: their stores alias nothing.
struct MotorColumns {
    const std::uint8_t* wanted;
    const std::uint16_t* phaseRate;
    std::uint16_t *phase, *fromPhase;
    std::uint8_t *segment, *fromSegment, *warpFrame, *warpLength;
};

[[nodiscard]] inline MotorColumns columnsOf(const MotorCommands& commands, MotionStates& states) {
    return {commands.segment.data(),
            commands.phaseRate.data(),
            states.phase.data(),
            states.fromPhase.data(),
            states.segment.data(),
            states.fromSegment.data(),
            states.warpFrame.data(),
            states.warpLength.data()};
}

// One tick's travel along the recorded path: the body frame leaves `start` for `end`, both as seen
// from a frame that the fish carries along, in which it moves by `translation` (body lengths).
struct Travel {
    Quaternion start, end;
    Quaternion bodyFromMean;  // at the end
    std::array<float, 3> translation{};
};

[[nodiscard]] inline Quaternion lerp(const Quaternion& a, const Quaternion& b, float share) {
    return {a.w + share * (b.w - a.w),
            a.x + share * (b.x - a.x),
            a.y + share * (b.y - a.y),
            a.z + share * (b.z - a.z)};
}

[[nodiscard]] inline float fractionOf(std::uint32_t phase) {
    return static_cast<float>(phase & 1023U) * kPhaseCellUnit;
}

// Whether the fish may leave its segment in this tick: a turn only plays to its end.
[[nodiscard]] inline bool mayLeave(const SegmentTables& tables,
                                   std::uint32_t phase,
                                   std::uint32_t rate) {
    return !tables.playsToEnd || phase + rate > 0xFFFFU;
}

inline void startWarp(const MotorTables& tables, const MotorColumns& fish, std::size_t i) {
    const WarpPlan plan =
        tables.segments[fish.segment[i]].warpTo[fish.phase[i] >> kPhaseCellBits][fish.wanted[i]];
    fish.fromSegment[i] = fish.segment[i];
    fish.fromPhase[i] = fish.phase[i];
    fish.segment[i] = fish.wanted[i];
    fish.phase[i] = plan.entryPhase;
    fish.warpFrame[i] = 0;
    fish.warpLength[i] = plan.frames;
}

// What a fish does in a tick: it glides in a motion warp, or plays its segment between two phases
// of the two-cycle path.
struct Playing {
    bool glides = true;
    std::uint32_t from = 0, to = 0;
};

// Advances segment, phase and warp counter by a tick. Counters run whether or not anyone looks. The
// commanded rate is that of the commanded segment; a turn that others wait for plays as recorded.
[[nodiscard]] inline Playing advanceSegment(const MotorTables& tables,
                                            const MotorColumns& fish,
                                            std::size_t i) {
    if (fish.warpFrame[i] != fish.warpLength[i]) {
        ++fish.warpFrame[i];
        return {};
    }
    const std::uint32_t phase = fish.phase[i];
    std::uint32_t rate = fish.phaseRate[i];
    if (fish.wanted[i] != fish.segment[i]) {
        const SegmentTables& playing = tables.segments[fish.segment[i]];
        rate = playing.phaseRate;
        if (fish.wanted[i] < kActions && mayLeave(playing, phase, rate)) {
            startWarp(tables, fish, i);
            return {};
        }
    }
    fish.phase[i] = static_cast<std::uint16_t>(phase + rate);
    return {.glides = false, .from = phase, .to = phase + rate};
}

[[nodiscard]] inline GlideSample glideAt(const SegmentTables& tables, std::uint32_t phase) {
    const std::size_t cell = phase >> kPhaseCellBits;
    const float share = fractionOf(phase);
    const GlideSample& a = tables.glide[cell];
    const GlideSample& b = tables.glide[cell + 1];
    GlideSample at{.bodyFromMean = lerp(a.bodyFromMean, b.bodyFromMean, share)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        at.halfTurn[axis] = a.halfTurn[axis] + share * (b.halfTurn[axis] - a.halfTurn[axis]);
    }
    at.forward = a.forward + share * (b.forward - a.forward);
    return at;
}

// The paper does not say what the body frame does during a warp; frozen, the fish would halt. Here
// its mean frame glides on, from the speed and turn of the last pose to those of the first, while
// the body's sway goes over from the one's to the other's: so a warp never turns the course.
[[nodiscard]] inline Travel glidingTravel(const MotorTables& tables,
                                          const MotorColumns& fish,
                                          std::size_t i) {
    const SegmentTables& next = tables.segments[fish.segment[i]];
    const GlideSample a = glideAt(tables.segments[fish.fromSegment[i]], fish.fromPhase[i]);
    const GlideSample b = glideAt(next, fish.phase[i]);
    const float tempo = static_cast<float>(fish.phaseRate[i]) * next.inversePhaseRate;
    const float steps = 1.0F / static_cast<float>(fish.warpLength[i] + 1);
    const float before = static_cast<float>(fish.warpFrame[i]) * steps;
    const float after = static_cast<float>(fish.warpFrame[i] + 1) * steps;
    const float half = 0.5F * (before + after);
    const auto blended = [&](float from, float to) { return tempo * (from + half * (to - from)); };
    const Quaternion turn{1.0F,
                          blended(a.halfTurn[0], b.halfTurn[0]),
                          blended(a.halfTurn[1], b.halfTurn[1]),
                          blended(a.halfTurn[2], b.halfTurn[2])};
    const auto swayAt = [&](float share) {
        return normalised(lerp(a.bodyFromMean, b.bodyFromMean, share));
    };
    const Quaternion sway = swayAt(after);
    return {.start = conjugate(swayAt(before)),
            .end = turn * conjugate(sway),
            .bodyFromMean = sway,
            .translation = {blended(a.forward, b.forward), 0.0F, 0.0F}};
}

}  // namespace aquarama
