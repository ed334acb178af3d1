// SPDX-License-Identifier: Apache-2.0
// A take as comma-separated values: a row a frame, the name and unit of each column on top.
#pragma once

#include <string>

#include "master/capture/exchange/take.h"

namespace aquarama::exchange {

// "time_s,n0_x_m,n0_y_m,n0_z_m,n1_x_m,...": the 23 nodal points of the paper's Fig. 1, the shortest
// decimals that are the same float, a point in them whatever the locale.
[[nodiscard]] std::string csvOf(const Take& take);

}  // namespace aquarama::exchange
