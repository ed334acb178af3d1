// SPDX-License-Identifier: Apache-2.0
// The figure of the nine motor controllers: what the biomechanical fish does after an order.
#pragma once

#include <string>

#include "common/config/species.h"

namespace aquarama::report {

inline constexpr int kMoments = 240;  // intervals between the recorded moments of a trial

// The biomechanical fish under each of the nine motor controllers, simulated in this call: most
// trials start in medium swimming; balance starts rolled by 40 degrees and retreat at rest. JSON.
[[nodiscard]] std::string controllersData(const config::Species& species);

}  // namespace aquarama::report
