// SPDX-License-Identifier: Apache-2.0
// What a pilot's hands ask of the submarine at one moment: a state, not a change, so that one that
// is lost is made good by the next.
#pragma once

#include <cstdint>

namespace aquarama {

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
