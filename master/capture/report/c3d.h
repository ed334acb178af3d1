// SPDX-License-Identifier: Apache-2.0
// A take as files of other programs: C3D, the exchange format of motion capture, and CSV; and the
// names of the 23 nodal points, which are the markers there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "master/capture/report/take.h"

namespace aquarama::report {

// `node` is 0 to 22, in the order of biomechanical_fish.h.
// "NOSE", "R1_DL" .. "R5_VL" (ring, dorsal or ventral, left or right), "TAIL_D", "TAIL_V".
[[nodiscard]] std::string markerLabel(std::size_t node);
// "nodal point 1, ring 1 of 5, dorsal left"
[[nodiscard]] std::string markerDescription(std::size_t node);

// A take as comma-separated values: a row for each frame, below a row with the name and unit of
// each column, "time_s,n0_x_m,n0_y_m,n0_z_m,n1_x_m,...". Columns are the 23 nodal points of the
// paper's Fig. 1. Numbers are the shortest decimals that give the same float, with a decimal point
// in every locale.
[[nodiscard]] std::string csvOf(const Take& take);

// A take as a C3D file (The C3D File Format User Guide, Motion Lab Systems 2008). Each nodal point
// is a marker, in metres, Y up: Intel byte order, floating-point data, no analogue channels.
// POINT:X_SCREEN is +X and POINT:Y_SCREEN +Y. At most kMostFrames frames.
[[nodiscard]] std::vector<std::byte> c3dOf(const Take& take);

}  // namespace aquarama::report
