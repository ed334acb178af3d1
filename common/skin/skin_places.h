// SPDX-License-Identifier: Apache-2.0
// Where each vertex and triangle of the surface is on the fish: the skin shader's coordinates.
#pragma once

#include "common/skin/face_grid.h"
#include "common/skin/limit_table.h"

namespace aquarama::skin {

// Height of a place at rest: -1 on the belly .. +1 on the back, as SkinPlace has it.
[[nodiscard]] float heightOnBody(const body::FishBody& body, float s, float y);

// Fills vertices, indices and bodyIndices of a table whose stencils are made.
void paintPlaces(const body::FishBody& body, const FaceGrid& grid, LimitTable& table);

}  // namespace aquarama::skin
