// SPDX-License-Identifier: Apache-2.0
// Counters and names as types, so that a tick is never taken for a frame nor a fish for an index.
#pragma once

#include <compare>
#include <cstdint>

namespace aquarama {

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

}  // namespace aquarama
