// SPDX-License-Identifier: Apache-2.0
// The state of the school's motion in integers, and the arithmetic that every machine shares to the
// bit.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/record_units.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {

// Quaternions with a fixed order of operations: + - * / and sqrt only, all of which IEEE 754
// defines to the bit, and no fused multiply-add. So the vectorised step can be tested for equal
// bits. Rounding is to nearest even.
struct Quaternion {
    float w = 1.0F, x = 0.0F, y = 0.0F, z = 0.0F;
};

// A unit quaternion as its smallest three components, in units of kOrientationUnit: the one of
// largest magnitude is left out and taken as positive. abc are the others in the order w, x, y, z.
struct PackedOrientation {
    std::array<std::int32_t, 3> abc{};
    std::uint8_t largest = 0;
};

// 2^19 - 1: fits 20 bits with either sign.
inline constexpr float kOrientationLimit = 524287.0F;

// To the nearest integer, ties to even. Exact for |value| up to 2^51 (double) and 2^22 (float): the
// last bit of the sum is worth one, so the processor rounds the fraction away.
[[nodiscard]] inline double roundToEven(double value) {
    constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
    return (value + kShift) - kShift;
}
[[nodiscard]] inline float roundToEven(float value) {
    constexpr float kShift = 12582912.0F;  // 1.5 * 2^23
    return (value + kShift) - kShift;
}

// The product a * b rotates by b first.
[[nodiscard]] inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {(a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z),
            (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
            (a.w * b.y + a.y * b.w) + (a.z * b.x - a.x * b.z),
            (a.w * b.z + a.z * b.w) + (a.x * b.y - a.y * b.x)};
}

// The inverse of a unit quaternion.
[[nodiscard]] inline Quaternion conjugate(const Quaternion& q) {
    return {q.w, -q.x, -q.y, -q.z};
}

// q must not be zero.
[[nodiscard]] inline Quaternion normalised(const Quaternion& q) {
    const float inverse = 1.0F / std::sqrt((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
    return {q.w * inverse, q.x * inverse, q.y * inverse, q.z * inverse};
}

// For a quaternion within a few thousandths of unit length: one Newton step squares the error,
// without a square root or a division.
[[nodiscard]] inline Quaternion renormalised(const Quaternion& q) {
    const float inverse = 1.5F - 0.5F * ((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
    return {q.w * inverse, q.x * inverse, q.y * inverse, q.z * inverse};
}

// The component that was left out follows from the unit length.
[[nodiscard]] inline Quaternion unpack(const PackedOrientation& packed) {
    const float a = static_cast<float>(packed.abc[0]) * kOrientationUnit;
    const float b = static_cast<float>(packed.abc[1]) * kOrientationUnit;
    const float c = static_cast<float>(packed.abc[2]) * kOrientationUnit;
    const float squared = 1.0F - ((a * a + b * b) + c * c);
    const float most = std::sqrt(squared > 0.0F ? squared : 0.0F);
    switch (packed.largest) {
        case 0:
            return {most, a, b, c};
        case 1:
            return {a, most, b, c};
        case 2:
            return {a, b, most, c};
        default:
            return {a, b, c, most};
    }
}

// One component, rounded and kept within 20 bits.
[[nodiscard]] inline std::int32_t orientationUnits(float component) {
    const float units = component * kOrientationUnitsPerOne;
    const float bounded = units < -kOrientationLimit  ? -kOrientationLimit
                          : units > kOrientationLimit ? kOrientationLimit
                                                      : units;
    return static_cast<std::int32_t>(roundToEven(bounded));
}

// q: of unit length. Of equally large components the first is left out. The sign of the quaternion,
// which means nothing for a rotation, is chosen so that the missing component is positive.
[[nodiscard]] inline PackedOrientation pack(const Quaternion& q) {
    std::array<float, 4> c{q.w, q.x, q.y, q.z};
    std::uint8_t largest = 0;
    for (std::uint8_t i = 1; i < 4; ++i) {
        if (std::abs(c[i]) > std::abs(c[largest])) largest = i;
    }
    PackedOrientation packed{.largest = largest};
    const float sign = c[largest] < 0.0F ? -1.0F : 1.0F;
    std::size_t slot = 0;
    for (std::uint8_t i = 0; i < 4; ++i) {
        if (i != largest) packed.abc[slot++] = orientationUnits(sign * c[i]);
    }
    return packed;
}

// The state of a school's motion: integers only, so that every machine agrees to the bit
// (docs/architecture.md).

inline constexpr std::int32_t kFastestUnits = 4194303;  // of speed: 16 body lengths a second
inline constexpr float kYawUnit = 1.0F / 1048576.0F;    // of MotorCommands::yawRate, radians a tick
// Of MotionStates::spread in a tick: fins are spread within a fifth of a second.
inline constexpr int kSpreadStep = 21;
// Of MotionStates::mouth in a tick: a mouth snaps open within a seventh of a second.
inline constexpr int kMouthStep = 32;

// Structure of arrays, one element for each fish; all columns have the same length. The world owns
// it; during a tick, each thread writes a range of fish of its own. Position of the body frame's
// origin in units of 2^-16 m; orientation as the smallest three of a unit quaternion, 20 bits each;
// phase in 1/65536 of a cycle.
struct MotionStates {
    std::vector<std::int32_t> x, y, z;
    // Signed 20-bit, in units of 2^-19 / sqrt(2).
    std::vector<std::int32_t> orientationA, orientationB, orientationC;
    // Which of w, x, y, z (0 to 3) is left out; it is >= 0.
    std::vector<std::uint8_t> orientationLargest;
    std::vector<std::uint16_t> phase;
    std::vector<std::uint16_t> segment;  // below kSegments
    // A motion warp goes from a frozen pose of one segment to the first pose of the next (section
    // 4.2).
    std::vector<std::uint16_t> fromPhase;
    std::vector<std::uint16_t> fromSegment;
    // From 0 to warpLength, which is K, the number of interpolated frames; equal when no warp is
    // under way.
    std::vector<std::uint8_t> warpFrame;
    std::vector<std::uint8_t> warpLength;
    // Along the mean frame's x axis, in units of 2^-18 body lengths a second; backwards is
    // negative.
    std::vector<std::int32_t> speed;
    // How far the pectoral fins are spread, in 1/255: it follows MotorCommands::brake by
    // kSpreadStep a tick.
    std::vector<std::uint8_t> spread;
    // How far the mouth is open, in 1/255: it follows MotorCommands::mouth by kMouthStep a tick.
    std::vector<std::uint8_t> mouth;
    // Where the eyes look (gaze.h): they follow MotorCommands::gaze by a step a tick.
    std::vector<std::uint8_t> gaze;

    // Gives each of so many fish an element of every column.
    void resize(std::size_t fish);
    // Number of fish.
    [[nodiscard]] std::size_t size() const { return x.size(); }
    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;
};

// The commands of the mind to the body; the motor's only input. One element for each fish. They
// change when a fish decides, not at every tick.
struct MotorCommands {
    std::vector<std::uint8_t> action;  // to play next
    // How fast to play that action, in 1/65536 of a cycle in a tick, not negative; a turn that has
    // to play to its end first does so as recorded.
    std::vector<std::int16_t> phaseRate;
    // How far the pectoral fins are spread, in 1/255.
    std::vector<std::uint8_t> brake;
    // How far the mouth is to be open, in 1/255, and where the eyes are to look (gaze.h).
    std::vector<std::uint8_t> mouth, gaze;
    // Sine of the desired pitch, in units of 2^-15; up is positive.
    std::vector<std::int16_t> pitch;
    // Turn about the world's up in addition to the played one, in units of 2^-20 rad a tick; left
    // is positive.
    std::vector<std::int16_t> yawRate;

    // Gives each of so many fish an element of every column.
    void resize(std::size_t fish);
    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;
};

// The constant properties of a fish, which are sent once to each node.
struct FishTraits {
    std::uint32_t id = 0;
    // The alpha of eq. 12: the recorded data are in body lengths.
    std::uint16_t lengthMillimetres = 0;
};

// One fish on the wire and on its way to the GPU: exactly the bits of MotionStates, little-endian.
struct FishRecord {
    std::int32_t x = 0, y = 0, z = 0;
    // The low and high half of a | b << 20 | c << 40 | largest << 60 (20-bit two's complement).
    std::uint32_t orientationLow = 0, orientationHigh = 0;
    std::uint16_t phase = 0, fromPhase = 0;
    std::uint16_t segment = 0, fromSegment = 0;
    // Low 24 bits: the speed in two's complement; high 8: the spread.
    std::uint32_t speedAndSpread = 0;
    std::uint8_t warpFrame = 0, warpLength = 0;
    // MotionStates::mouth and gaze.
    std::uint8_t mouth = 0, gaze = 0;
    std::uint32_t skin =
        0;  // number of a visitor's drawing that it wears; 0: its species' own skin
    friend bool operator==(const FishRecord&, const FishRecord&) = default;
};
static_assert(sizeof(FishRecord) == 40);
inline constexpr std::uint32_t kMostSkin = 9'999'999;  // of FishRecord::skin

// FishRecord::speedAndSpread of its two parts, and back.
[[nodiscard]] inline std::uint32_t packedSpeedAndSpread(std::int32_t speed, std::uint8_t spread) {
    return (static_cast<std::uint32_t>(speed) & 0xFFFFFFU) | std::uint32_t{spread} << 24U;
}
[[nodiscard]] inline std::int32_t speedOf(const FishRecord& record) {
    return static_cast<std::int32_t>(record.speedAndSpread << 8U) >> 8;
}
[[nodiscard]] inline std::uint8_t spreadOf(const FishRecord& record) {
    return static_cast<std::uint8_t>(record.speedAndSpread >> 24U);
}

// Convert one fish of the columns to a record and back, without loss.
[[nodiscard]] FishRecord recordOf(const MotionStates& states, std::size_t fish);
void setFromRecord(MotionStates& states, std::size_t fish, const FishRecord& record);

// Whether motor and reconstruction can play a record: segments that exist, a warp within its
// length, a speed within kFastestUnits, unused bits zero. Any mouth and gaze can be shown. Decoders
// refuse any other, so no index into a table needs a check.
[[nodiscard]] bool isPlayable(const FishRecord& record);

// The body frame as floats: the position of its origin o in metres, and the rotation that takes
// body axes (x anterior, y dorsal, z right) to world axes.
struct BodyFrame {
    glm::vec3 position{};
    glm::quat rotation{1, 0, 0, 0};
};
[[nodiscard]] BodyFrame bodyFrameOf(const FishRecord& record);
[[nodiscard]] BodyFrame bodyFrameOf(const MotionStates& states, std::size_t fish);
// Rounds to the integers; the rotation need not be of unit length.
void setBodyFrame(MotionStates& states, std::size_t fish, const BodyFrame& frame);

// Speed in body lengths a second. Setting it rounds to integers and limits it to kFastestUnits; the
// speed must be finite.
[[nodiscard]] float speedBodyLengths(const MotionStates& states, std::size_t fish);
void setSpeedBodyLengths(MotionStates& states, std::size_t fish, float speed);

// A fish that is not in the water: see kAwayHeightMetres.
[[nodiscard]] bool isAway(const FishRecord& record);
[[nodiscard]] bool isAway(const MotionStates& states, std::size_t fish);
void setAway(MotionStates& states, std::size_t fish);

// Folds every bit of the state that moves a fish into one number: equal worlds have equal hashes.
// Mouth and gaze are only seen. Cost: five multiply chains for each fish.
[[nodiscard]] std::uint64_t hashOf(const MotionStates& states);
// The same hash from records of the same fish.
[[nodiscard]] std::uint64_t hashOf(std::span<const FishRecord> records);

}  // namespace aquarama::motion
