// SPDX-License-Identifier: Apache-2.0
// Where each vertex and triangle of the surface is on the fish: the painter's coordinates.
#pragma once

#include "common/skin/face_grid.h"
#include "common/skin/limit_table.h"

namespace aquarama {

// Fills vertices, indices and bodyIndices of a table whose stencils are made.
void paintPlaces(const FishBody& body, const FaceGrid& grid, LimitTable& table);

}  // namespace aquarama
