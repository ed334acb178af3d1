// SPDX-License-Identifier: Apache-2.0
// The shapes of rock: worn limestone with ledges, undercuts and hollows, within the unit ball.
#pragma once

#include <cstdint>

#include "render_node/reef/mesh.h"

namespace aquarama::scene {

inline constexpr int kRockShapes = 12;

// Nothing stands out of the unit ball. y stays up: a rock may be turned about it, but its ledges
// lie level. Coarser levels are every second vertex of the finer one. Albedo: lightness, how much
// turf, how much pink crust.
[[nodiscard]] Levels growRock(int shape);

}  // namespace aquarama::scene
