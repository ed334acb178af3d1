// SPDX-License-Identifier: Apache-2.0
// A take as a C3D file, the exchange format of motion capture (The C3D File Format User Guide,
// Motion Lab Systems 2008).
#pragma once

#include <cstddef>
#include <vector>

#include "master/capture/exchange/take.h"

namespace aquarama::exchange {

// One marker a nodal point, in metres, Y up: Intel byte order, floating-point data, no analogue
// channels. POINT:X_SCREEN is +X and POINT:Y_SCREEN +Y. At most kMostFrames frames.
[[nodiscard]] std::vector<std::byte> c3dOf(const Take& take);

}  // namespace aquarama::exchange
