// SPDX-License-Identifier: Apache-2.0
// Motion warps between the segments of a repertoire: to which phase of the next one, and in how
// many frames (paper, section 4.2). Computed without libm but for square roots, so they are the
// same on every machine.
#pragma once

#include <array>
#include <cstdint>

#include "common/motion/repertoire.h"

namespace aquarama::motion {

inline constexpr unsigned kPhaseCellBits = 10;  // a phase of 16 bits is 6 of cell, 10 of fraction
inline constexpr float kPhaseCellUnit = 1.0F / 1024.0F;

// The plan of a motion warp from one segment, in a cell of its phases, to another.
struct WarpPlan {
    std::uint16_t entryPhase = 0;
    std::uint8_t frames = 0;  // K, interpolated frames between the last pose and the first
};

// Which phase a motion warp glides to, and in how many frames (paper, section 4.2): by the action
// that is left, the cell of its phase and the next action.
using WarpPlans = std::array<std::array<std::array<WarpPlan, kActions>, kPhases>, kActions>;

// phaseRates: as recorded, 1/65536 of a cycle in a tick. For every pair of actions compares all
// pairs of phases, about 3 million pairs of poses.
[[nodiscard]] WarpPlans planWarps(const Repertoire& repertoire,
                                  const std::array<std::int16_t, kActions>& phaseRates);

}  // namespace aquarama::motion
