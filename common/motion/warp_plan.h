// SPDX-License-Identifier: Apache-2.0
// Which phase a motion warp glides to, and in how many frames (paper, section 4.2).
#pragma once

#include <array>

#include "common/motion/motor_tables.h"

namespace aquarama::motion {

using WarpPlans = std::array<std::array<std::array<WarpPlan, kActions>, kPhases>, kActions>;

// [from][cell of its phase][to]. phaseRates: as recorded, 1/65536 of a cycle in a tick.
[[nodiscard]] WarpPlans planWarps(const Repertoire& repertoire,
                                  const std::array<std::int16_t, kActions>& phaseRates);

}  // namespace aquarama::motion
