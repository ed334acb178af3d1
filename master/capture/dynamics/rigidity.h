// SPDX-License-Identifier: Apache-2.0
// Whether springs hold a shape.
#pragma once

#include <span>

#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama::capture {

// All motions of the nodal points but moving and turning as one.
inline constexpr int kShapeChanges = 3 * body::kNodalPoints - 6;

// How many changes of shape, to first order, lengthen no unit: kShapeChanges less the rank of the
// rigidity matrix. A fish with one or more would fold up there at no cost.
[[nodiscard]] int freeShapeChanges(const NodeVectors& positions, std::span<const Unit> units);

}  // namespace aquarama::capture
