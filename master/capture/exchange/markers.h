// SPDX-License-Identifier: Apache-2.0
// What the 23 nodal points are called where they are markers.
#pragma once

#include <cstddef>
#include <string>

namespace aquarama::exchange {

// "NOSE", "R1_DL" .. "R5_VL" (ring, dorsal or ventral, left or right), "TAIL_D", "TAIL_V".
[[nodiscard]] std::string markerLabel(std::size_t node);
// "nodal point 1, ring 1 of 5, dorsal left"
[[nodiscard]] std::string markerDescription(std::size_t node);

}  // namespace aquarama::exchange
