// SPDX-License-Identifier: Apache-2.0
// The state of a school's motion: integers only, so that every machine agrees to the bit
// (docs/architecture.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/repertoire.h"

namespace aquarama::motion {

inline constexpr float kPositionUnitMetres = 1.0F / 65536.0F;
inline constexpr float kSpeedUnitsPerBodyLength = 262144.0F;  // 2^18
inline constexpr std::int32_t kFastestUnits = 4194303;        // 16 body lengths a second

// Structure of arrays, one element a fish. Position of the body frame's origin in units of 2^-16 m;
// orientation as the smallest three of a unit quaternion, 20 bits each; phase in 1/65536 of a
// cycle.
struct MotionStates {
    std::vector<std::int32_t> x, y, z;
    std::vector<std::int32_t> orientationA, orientationB,
        orientationC;                              // signed 20-bit, in units of 2^-19 / sqrt(2)
    std::vector<std::uint8_t> orientationLargest;  // which of w, x, y, z is left out (it is >= 0)
    std::vector<std::uint16_t> phase;
    std::vector<std::uint8_t> segment;  // Action
    // A motion warp glides from a frozen pose of one segment to the first pose of the next
    // (section 4.2).
    std::vector<std::uint16_t> fromPhase;
    std::vector<std::uint8_t> fromSegment;
    std::vector<std::uint8_t> warpFrame;   // 0 .. warpLength; equal when no warp is under way
    std::vector<std::uint8_t> warpLength;  // K interpolated frames
    // Along the mean frame's x axis, in units of 2^-18 body lengths a second; backwards is
    // negative.
    std::vector<std::int32_t> speed;

    void resize(std::size_t fish);
    [[nodiscard]] std::size_t size() const { return x.size(); }
};

// What the mind asks of the body; the motor's only input. It changes at decision instants, not
// every tick.
struct MotorCommands {
    std::vector<std::uint8_t> segment;  // Action to play next
    // Of that action, in 1/65536 of a cycle in a tick; a turn that first plays to its end does so
    // as recorded. Negative: the cycle is played backwards, and the fish retreats. A turn has no
    // way back, and takes the magnitude.
    std::vector<std::int16_t> phaseRate;
    std::vector<std::uint8_t> brake;  // share of the pectoral fins that is spread, in 1/255
    std::vector<std::int16_t> pitch;  // sine of the wanted pitch, in units of 2^-15; up is positive
    std::vector<std::int16_t>
        yawRate;  // extra turn about the world's up, in units of 2^-20 rad a tick; left is positive

    void resize(std::size_t fish);
};

// What never changes about a fish, sent once.
struct FishTraits {
    std::uint32_t id = 0;
    std::uint16_t lengthMillimetres = 0;  // alpha of eq. 12: the recorded data are in body lengths
};

// One fish on the wire and on its way to the GPU: exactly the bits of MotionStates, little-endian.
struct FishRecord {
    std::int32_t x = 0, y = 0, z = 0;
    std::uint32_t orientationLow = 0,
                  orientationHigh =
                      0;  // a | b << 20 | c << 40 | largest << 60 (20-bit two's complement)
    std::uint16_t phase = 0, fromPhase = 0;
    std::uint8_t segment = 0, fromSegment = 0, warpFrame = 0, warpLength = 0;
    std::int32_t speed = 0;
    friend bool operator==(const FishRecord&, const FishRecord&) = default;
};
static_assert(sizeof(FishRecord) == 32);

[[nodiscard]] FishRecord recordOf(const MotionStates& states, std::size_t fish);
void setFromRecord(MotionStates& states, std::size_t fish, const FishRecord& record);

// Whether the motor and the reconstruction can play it: segments that exist, a warp within its
// length, a speed within kFastestUnits, no stray bits. A decoder refuses any other.
[[nodiscard]] bool isPlayable(const FishRecord& record);

// The body frame as floats: position of o in metres, rotation that takes body axes (x anterior, y
// dorsal, z right) to world.
struct BodyFrame {
    glm::vec3 position{};
    glm::quat rotation{1, 0, 0, 0};
};
[[nodiscard]] BodyFrame bodyFrameOf(const FishRecord& record);
[[nodiscard]] BodyFrame bodyFrameOf(const MotionStates& states, std::size_t fish);
void setBodyFrame(MotionStates& states,
                  std::size_t fish,
                  const BodyFrame& frame);  // rounds to the integers

// Body lengths a second; set, it is rounded and kept within kFastestUnits.
[[nodiscard]] float speedBodyLengths(const MotionStates& states, std::size_t fish);
void setSpeedBodyLengths(MotionStates& states, std::size_t fish, float speed);

// A fish that is not in the water: eaten, until another comes in its place. It keeps its index, and
// its body frame is so far below every sea floor that no wall ever shows it.
inline constexpr float kAwayHeightMetres = -16384.0F;
[[nodiscard]] bool isAway(const FishRecord& record);
[[nodiscard]] bool isAway(const MotionStates& states, std::size_t fish);
void setAway(MotionStates& states, std::size_t fish);

// Folds every bit of the state into one number; equal worlds have equal hashes.
[[nodiscard]] std::uint64_t hashOf(const MotionStates& states);

}  // namespace aquarama::motion
