// SPDX-License-Identifier: Apache-2.0
// Units, limits and counters that all parts share.
#pragma once

#include <compare>
#include <cstdint>
#include <numbers>

namespace aquarama {

// Radians in a degree. Files and messages use degrees, code uses radians.
template <class Real>
inline constexpr Real kRadiansPerDegree = std::numbers::pi_v<Real> / 180;
inline constexpr double kDegree = kRadiansPerDegree<double>;
[[nodiscard]] constexpr double degreesOf(double radians) {
    return radians / kDegree;
}

// The largest world: readers and decoders refuse larger ones.
inline constexpr std::uint32_t kMostFish = 1'000'000;
// A set of species is the bits of one 64-bit number.
inline constexpr std::uint32_t kMostSpecies = 64;

// Counters and names as types, so that a tick is never taken for a frame nor a fish for an index.

// One step of the simulation; tick 0 is the world before its first step.
struct Tick {
    std::uint64_t value = 0;
    friend constexpr auto operator<=>(Tick, Tick) = default;
};

// One refresh of the display, numbered from 0 on the whole wall alike.
struct Frame {
    std::uint64_t value = 0;
    friend constexpr auto operator<=>(Frame, Frame) = default;
};

// The name of a fish, never used again in the life of a world.
struct FishId {
    std::uint32_t value = 0;
    friend constexpr auto operator<=>(FishId, FishId) = default;
};

// Ticks of the simulation in a second, on every machine.
inline constexpr double kTicksPerSecond = 60.0;
inline constexpr double kTicksPerMinute = 60.0 * kTicksPerSecond;
[[nodiscard]] constexpr float secondsOfTicks(std::uint32_t ticks) {
    return static_cast<float>(ticks) / static_cast<float>(kTicksPerSecond);
}

// The state of a pilot's controls at one moment. It is not a change, so the next message replaces a
// lost one.

// Full deflection of an axis, to either side.
inline constexpr std::int8_t kFullSteering = 127;
// After so many ticks without a message the controls count as released, so that a dead window does
// not leave the submarine at full speed.
inline constexpr std::uint64_t kTicksOfAHand = 30;

// Deflections in 1/kFullSteering. Whole numbers: the same on the wire, in a recording and on every
// machine.
struct Steering {
    std::int8_t ahead = 0;  // along the nose, or back
    std::int8_t aside = 0;  // to the right
    std::int8_t up = 0;     // rise, or sink
    std::int8_t turn = 0;   // to the left
    std::int8_t tilt = 0;   // nose up
    friend bool operator==(const Steering&, const Steering&) = default;
};

}  // namespace aquarama
