// SPDX-License-Identifier: Apache-2.0
#include "common/motion/motion_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/digest.h"

namespace aquarama::motion {
namespace {

constexpr std::uint64_t kMask20 = 0xFFFFF;

// 20-bit two's complement: the low bits of a number, and the number that such bits mean.
std::uint64_t low20(std::int32_t value) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)) & kMask20;
}

std::int32_t signed20(std::uint64_t bits) {
    const auto value = static_cast<std::int32_t>(bits & kMask20);
    return value >= 0x80000 ? value - 0x100000 : value;
}

// The finaliser of MurmurHash3: each input bit changes half of the output bits.
std::uint64_t mix(std::uint64_t h) {
    h = (h ^ h >> 33U) * 0xFF51AFD7ED558CCDU;
    h = (h ^ h >> 33U) * 0xC4CEB9FE1A85EC53U;
    return h ^ h >> 33U;
}

// Two numbers in one word.
std::uint64_t pair(std::int32_t low, std::int32_t high) {
    return static_cast<std::uint32_t>(low) |
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32U;
}

PackedOrientation orientationOf(const MotionStates& s, std::size_t fish) {
    return {{s.orientationA[fish], s.orientationB[fish], s.orientationC[fish]},
            s.orientationLargest[fish]};
}

BodyFrame frameOf(std::int32_t x, std::int32_t y, std::int32_t z, const PackedOrientation& packed) {
    const Quaternion q = unpack(packed);
    return {glm::vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) *
                kPositionUnitMetres,
            glm::quat(q.w, q.x, q.y, q.z)};
}

// Rounded, and kept within 32 bits. In double, because a float has no room for 2^-16 m far from the
// origin.
std::int32_t positionUnits(float metres) {
    constexpr double kFar = 2147483647.0;
    const double units = static_cast<double>(metres) / static_cast<double>(kPositionUnitMetres);
    const double bounded = units < -kFar ? -kFar : units > kFar ? kFar : units;
    return static_cast<std::int32_t>(roundToEven(bounded));
}

static_assert(kAwayBelow == static_cast<int>(kAwayHeightMetres / kPositionUnitMetres) / 2);

template <class RecordAt>
std::uint64_t foldedRecords(std::size_t count, RecordAt&& recordAt) {
    const auto wide = [](auto field) { return static_cast<std::uint64_t>(field); };
    std::uint64_t hash = mix(count);
    for (std::size_t fish = 0; fish < count; ++fish) {
        const FishRecord r = recordAt(fish);
        // Five words that do not depend on each other, so the processor works on them side by side;
        // only the last line waits for the fish before.
        const std::int32_t phases = r.phase | static_cast<std::int32_t>(wide(r.fromPhase) << 16U);
        const std::uint64_t place = mix(pair(r.x, r.y)) + 3 * mix(pair(r.z, phases));
        const std::uint64_t turn = mix(wide(r.orientationLow) | wide(r.orientationHigh) << 32U);
        const std::uint64_t played =
            wide(r.segment) | wide(r.fromSegment) << 16U | wide(r.speedAndSpread) << 32U;
        const std::uint64_t warp = wide(r.warpFrame) | wide(r.warpLength) << 8U;
        hash = hash * 0x9E3779B97F4A7C15U +
               (place + 5 * turn + 7 * mix(played + 1) + 9 * mix(warp + 2));
    }
    return mix(hash);
}

}  // namespace

void MotionStates::resize(std::size_t fish) {
    for (auto* column : {&x, &y, &z, &orientationA, &orientationB, &orientationC}) {
        column->resize(fish);
    }
    speed.resize(fish);
    for (auto* column : {&phase, &fromPhase, &segment, &fromSegment}) column->resize(fish);
    for (auto* column : {&orientationLargest, &warpFrame, &warpLength, &spread, &mouth, &gaze})
        column->resize(fish);
}

std::size_t MotionStates::bytes() const {
    return bytesIn(x, y, z, orientationA, orientationB, orientationC, orientationLargest, phase) +
           bytesIn(segment, fromPhase, fromSegment, warpFrame, warpLength, speed, spread) +
           bytesIn(mouth, gaze);
}

void MotorCommands::resize(std::size_t fish) {
    action.resize(fish);
    phaseRate.resize(fish);
    brake.resize(fish);
    mouth.resize(fish);
    gaze.resize(fish);
    pitch.resize(fish);
    yawRate.resize(fish);
}

std::size_t MotorCommands::bytes() const {
    return bytesIn(action, phaseRate, brake, mouth, gaze, pitch, yawRate);
}

FishRecord recordOf(const MotionStates& states, std::size_t fish) {
    assert(fish < states.size());
    const std::uint64_t orientation =
        low20(states.orientationA[fish]) | low20(states.orientationB[fish]) << 20U |
        low20(states.orientationC[fish]) << 40U |
        static_cast<std::uint64_t>(states.orientationLargest[fish] & 3U) << 60U;
    return {.x = states.x[fish],
            .y = states.y[fish],
            .z = states.z[fish],
            .orientationLow = static_cast<std::uint32_t>(orientation),
            .orientationHigh = static_cast<std::uint32_t>(orientation >> 32U),
            .phase = states.phase[fish],
            .fromPhase = states.fromPhase[fish],
            .segment = states.segment[fish],
            .fromSegment = states.fromSegment[fish],
            .speedAndSpread = packedSpeedAndSpread(states.speed[fish], states.spread[fish]),
            .warpFrame = states.warpFrame[fish],
            .warpLength = states.warpLength[fish],
            .mouth = states.mouth[fish],
            .gaze = states.gaze[fish]};
}

PackedOrientation orientationOf(const FishRecord& record) {
    const std::uint64_t bits =
        record.orientationLow | static_cast<std::uint64_t>(record.orientationHigh) << 32U;
    return {{signed20(bits), signed20(bits >> 20U), signed20(bits >> 40U)},
            static_cast<std::uint8_t>(bits >> 60U & 3U)};
}

void setFromRecord(MotionStates& states, std::size_t fish, const FishRecord& record) {
    assert(fish < states.size());
    const PackedOrientation orientation = orientationOf(record);
    states.x[fish] = record.x;
    states.y[fish] = record.y;
    states.z[fish] = record.z;
    states.orientationA[fish] = orientation.abc[0];
    states.orientationB[fish] = orientation.abc[1];
    states.orientationC[fish] = orientation.abc[2];
    states.orientationLargest[fish] = orientation.largest;
    states.phase[fish] = record.phase;
    states.fromPhase[fish] = record.fromPhase;
    states.segment[fish] = record.segment;
    states.fromSegment[fish] = record.fromSegment;
    states.warpFrame[fish] = record.warpFrame;
    states.warpLength[fish] = record.warpLength;
    states.speed[fish] = speedOf(record);
    states.spread[fish] = spreadOf(record);
    states.mouth[fish] = record.mouth;
    states.gaze[fish] = record.gaze;
}

bool isPlayable(const FishRecord& record) {
    return record.segment < kSegments && record.fromSegment < kSegments &&
           record.warpFrame <= record.warpLength && speedOf(record) <= kFastestUnits &&
           speedOf(record) >= -kFastestUnits && record.orientationHigh >> 30U == 0 &&
           record.skin <= kMostSkin;
}

BodyFrame bodyFrameOf(const FishRecord& record) {
    return frameOf(record.x, record.y, record.z, orientationOf(record));
}

BodyFrame bodyFrameOf(const MotionStates& states, std::size_t fish) {
    return frameOf(states.x[fish], states.y[fish], states.z[fish], orientationOf(states, fish));
}

void setBodyFrame(MotionStates& states, std::size_t fish, const BodyFrame& frame) {
    assert(fish < states.size());
    const glm::quat& q = frame.rotation;
    const PackedOrientation packed = pack(normalised({q.w, q.x, q.y, q.z}));
    states.x[fish] = positionUnits(frame.position.x);
    states.y[fish] = positionUnits(frame.position.y);
    states.z[fish] = positionUnits(frame.position.z);
    states.orientationA[fish] = packed.abc[0];
    states.orientationB[fish] = packed.abc[1];
    states.orientationC[fish] = packed.abc[2];
    states.orientationLargest[fish] = packed.largest;
}

bool isAway(const FishRecord& record) {
    return record.y < kAwayBelow;
}

bool isAway(const MotionStates& states, std::size_t fish) {
    return states.y[fish] < kAwayBelow;
}

void setAway(MotionStates& states, std::size_t fish) {
    assert(fish < states.size());
    states.y[fish] = positionUnits(kAwayHeightMetres);
}

float speedBodyLengths(const MotionStates& states, std::size_t fish) {
    return static_cast<float>(states.speed[fish]) / kSpeedUnitsPerBodyLength;
}

void setSpeedBodyLengths(MotionStates& states, std::size_t fish, float speed) {
    assert(fish < states.size());
    assert(std::isfinite(speed));
    constexpr auto kFastest = static_cast<float>(kFastestUnits);
    const float units = std::clamp(speed * kSpeedUnitsPerBodyLength, -kFastest, kFastest);
    states.speed[fish] = static_cast<std::int32_t>(roundToEven(units));
}

std::uint64_t hashOf(const MotionStates& states) {
    return foldedRecords(states.size(), [&](std::size_t fish) { return recordOf(states, fish); });
}

std::uint64_t hashOf(std::span<const FishRecord> records) {
    return foldedRecords(records.size(), [&](std::size_t fish) { return records[fish]; });
}

}  // namespace aquarama::motion
