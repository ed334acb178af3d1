// SPDX-License-Identifier: Apache-2.0
// What the 23 nodal points are called where they are markers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "master/capture/report/take.h"

namespace aquarama::report {

// "NOSE", "R1_DL" .. "R5_VL" (ring, dorsal or ventral, left or right), "TAIL_D", "TAIL_V".
[[nodiscard]] std::string markerLabel(std::size_t node);
// "nodal point 1, ring 1 of 5, dorsal left"
[[nodiscard]] std::string markerDescription(std::size_t node);

// A take as comma-separated values: a row a frame, the name and unit of each column on top.

// "time_s,n0_x_m,n0_y_m,n0_z_m,n1_x_m,...": the 23 nodal points of the paper's Fig. 1, the shortest
// decimals that are the same float, a point in them whatever the locale.
[[nodiscard]] std::string csvOf(const Take& take);

// A take as a C3D file, the exchange format of motion capture (The C3D File Format User Guide,
// Motion Lab Systems 2008).

// One marker a nodal point, in metres, Y up: Intel byte order, floating-point data, no analogue
// channels. POINT:X_SCREEN is +X and POINT:Y_SCREEN +Y. At most kMostFrames frames.
[[nodiscard]] std::vector<std::byte> c3dOf(const Take& take);

}  // namespace aquarama::report
