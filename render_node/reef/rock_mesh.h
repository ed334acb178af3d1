// SPDX-License-Identifier: Apache-2.0
// The shapes of rock: worn limestone with ledges, undercuts and hollows, within the unit ball.
#pragma once

#include <cstdint>

#include "render_node/reef/mesh.h"

namespace aquarama::scene {

// Number of shapes.
inline constexpr int kRockShapes = 12;

// Makes one shape at all levels, the same on every machine. It lies within the unit ball. y is up:
// a rock may be turned about y, so that its ledges stay level. Coarser levels are every second
// vertex of the finer one. The albedo of a vertex holds lightness, amount of turf and amount of
// pink crust. shape: 0 to kRockShapes - 1.
[[nodiscard]] Levels growRock(int shape);

}  // namespace aquarama::scene
