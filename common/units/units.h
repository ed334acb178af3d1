// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <numbers>

namespace aquarama {

// Radians in a degree: people write degrees, code keeps radians.
template <class Real>
inline constexpr Real kRadiansPerDegree = std::numbers::pi_v<Real> / 180;

// The largest world: what is larger is refused where it comes in, by a reader or a decoder.

inline constexpr std::uint32_t kMostFish = 1'000'000;
inline constexpr std::uint32_t kMostSpecies = 64;  // sets of them are the bits of one number

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

// Never reused in the life of a world.
struct FishId {
    std::uint32_t value = 0;
    friend constexpr auto operator<=>(FishId, FishId) = default;
};

inline constexpr double kTicksPerSecond = 60.0;

// What a pilot's hands ask of the submarine at one moment: a state, not a change, so that one that
// is lost is made good by the next.

inline constexpr std::int8_t kFullSteering = 127;  // of each axis, to either side
// A hand that is silent for longer holds nothing: a dead window never leaves the throttle open.
inline constexpr std::uint64_t kTicksOfAHand = 30;

// Whole numbers: the same on the wire, in a recording and on every machine.
struct Steering {
    std::int8_t ahead = 0;  // along the nose, or back
    std::int8_t aside = 0;  // to the right
    std::int8_t up = 0;     // rise, or sink
    std::int8_t turn = 0;   // to the left
    std::int8_t tilt = 0;   // nose up
    friend bool operator==(const Steering&, const Steering&) = default;
};

}  // namespace aquarama
