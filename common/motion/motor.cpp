// SPDX-License-Identifier: Apache-2.0
// The plain step, one fish at a time: the order of operations that the vectorised one repeats.
#include "common/motion/motor.h"

#include <algorithm>
#include <cmath>

#include "common/motion/motor_tick.h"

namespace aquarama {
namespace {

using Vector = std::array<float, 3>;

// Along the recorded path from one phase to another, up to a cycle later.
Travel playedTravel(const SegmentTables& tables, std::uint32_t from, std::uint32_t to) {
    const std::size_t a = from >> kPhaseCellBits;
    const std::size_t b = to >> kPhaseCellBits;
    const std::size_t c = b % kPhases;
    const float atStart = fractionOf(from);
    const float atEnd = fractionOf(to);
    Travel travel{.start = lerp(tables.path[a].rotation, tables.path[a + 1].rotation, atStart),
                  .end = lerp(tables.path[b].rotation, tables.path[b + 1].rotation, atEnd),
                  .bodyFromMean = lerp(tables.bodyFromMean[c], tables.bodyFromMean[c + 1], atEnd)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto place = [&](std::size_t cell, float share) {
            const float here = tables.path[cell].translation[axis];
            return here + share * (tables.path[cell + 1].translation[axis] - here);
        };
        travel.translation[axis] = place(b, atEnd) - place(a, atStart);
    }
    return travel;
}

Vector rotated(const Quaternion& q, const Vector& v) {
    const float x = 2.0F * (q.y * v[2] - q.z * v[1]);
    const float y = 2.0F * (q.z * v[0] - q.x * v[2]);
    const float z = 2.0F * (q.x * v[1] - q.y * v[0]);
    return {(v[0] + q.w * x) + (q.y * z - q.z * y),
            (v[1] + q.w * y) + (q.z * x - q.x * z),
            (v[2] + q.w * z) + (q.x * y - q.y * x)};
}

float bounded(float value, float limit) {
    return std::min(std::max(value, -limit), limit);
}

// The balancing roll about the nose (paper, section 4.2), from the heights of the fish's own up and
// right: towards upright, at full rate while belly-up, and none where the nose is vertical.
float levellingRoll(float up, float right) {
    if (up * up + right * right < kNoseVerticalSquared) return 0.0F;
    if (up < 0.0F) return std::copysign(kRollRate, right);
    return bounded(kRollGain * right, kRollRate);
}

// Half the turn that the fish adds in this tick, about world axes: commanded yaw about up, pitch
// about the level axis to its right, roll about its nose. Measured on the mean frame, else the tail
// beat would be steered against.
Vector halfSteering(const Quaternion& m, float pitchSine, float yaw) {
    const float forwardX = 1.0F - 2.0F * (m.y * m.y + m.z * m.z);
    const float forwardY = 2.0F * (m.x * m.y + m.w * m.z);
    const float forwardZ = 2.0F * (m.x * m.z - m.w * m.y);
    const float up = 1.0F - 2.0F * (m.x * m.x + m.z * m.z);
    const float right = 2.0F * (m.y * m.z - m.w * m.x);
    const float wanted = bounded(pitchSine, kSteepestPitch);
    const float pitch = bounded(kPitchGain * (wanted - forwardY), kPitchRate);
    const float levelZ = forwardX + kLevelAxisBias;
    const float squared = levelZ * levelZ + forwardZ * forwardZ;
    const float alongLevel = pitch / std::sqrt(std::max(squared, kTiniest));
    const float roll = levellingRoll(up, right);
    return {0.5F * (roll * forwardX - alongLevel * forwardZ),
            0.5F * (roll * forwardY + yaw),
            0.5F * (roll * forwardZ + alongLevel * levelZ)};
}

std::int32_t stepUnits(float units) {
    return static_cast<std::int32_t>(roundToEven(bounded(units, kLongestStepUnits)));
}

// Two's complement: the world has no edge to overflow at.
std::int32_t moved(std::int32_t position, std::int32_t step) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(position) +
                                     static_cast<std::uint32_t>(step));
}

Quaternion orientationOf(const MotionStates& s, std::size_t i) {
    return unpack(
        {{s.orientationA[i], s.orientationB[i], s.orientationC[i]}, s.orientationLargest[i]});
}

void stepFish(const MotorStep& step, const MotorColumns& columns, std::size_t i) {
    MotionStates& s = *step.states;
    const Playing playing = advanceSegment(*step.tables, columns, i);
    const SegmentTables& segment = step.tables->segments[s.segment[i]];
    const Travel travel = playing.glides ? glidingTravel(*step.tables, columns, i)
                                         : playedTravel(segment, playing.from, playing.to);
    // The frame from which the path is seen, in the world; eq. 11 with the fish's own length.
    const Quaternion seenFrom = renormalised(orientationOf(s, i) * conjugate(travel.start));
    const Vector moves = rotated(seenFrom, travel.translation);
    const float units = static_cast<float>(step.traits[i].lengthMillimetres) * kUnitsPerMillimetre;
    s.x[i] = moved(s.x[i], stepUnits(moves[0] * units));
    s.y[i] = moved(s.y[i], stepUnits(moves[1] * units));
    s.z[i] = moved(s.z[i], stepUnits(moves[2] * units));
    // Eq. 10 in body axes, then the fish's own steering.
    const Quaternion swum = seenFrom * travel.end;
    const Vector steering = halfSteering(swum * travel.bodyFromMean,
                                         static_cast<float>(step.commands->pitch[i]) * kPitchUnit,
                                         static_cast<float>(step.commands->yawRate[i]) * kYawUnit);
    const Quaternion turn{1.0F, steering[0], steering[1], steering[2]};
    const PackedOrientation packed = pack(renormalised(turn * swum));
    s.orientationA[i] = packed.abc[0];
    s.orientationB[i] = packed.abc[1];
    s.orientationC[i] = packed.abc[2];
    s.orientationLargest[i] = packed.largest;
}

}  // namespace

void MotorStep::runReference() const {
    const MotorColumns columns = columnsOf(*commands, *states);
    for (std::size_t fish = first; fish < last; ++fish) stepFish(*this, columns, fish);
}

glm::quat meanRotation(const MotorTables& tables, const MotionStates& states, std::size_t fish) {
    const float share = static_cast<float>(states.warpFrame[fish] + 1) /
                        static_cast<float>(states.warpLength[fish] + 1);
    const auto swayOf = [&](std::uint8_t segment, std::uint16_t phase) {
        return glideAt(tables.segments[segment], phase).bodyFromMean;
    };
    const Quaternion played = swayOf(states.segment[fish], states.phase[fish]);
    const bool warps = states.warpFrame[fish] != states.warpLength[fish];
    const Quaternion sway =
        warps ? lerp(swayOf(states.fromSegment[fish], states.fromPhase[fish]), played, share)
              : played;
    const Quaternion mean = normalised(orientationOf(states, fish) * sway);
    return {mean.w, mean.x, mean.y, mean.z};
}

}  // namespace aquarama
