// SPDX-License-Identifier: Apache-2.0
// Where each vertex and triangle of the surface is on the fish: the painter's coordinates.
#pragma once

#include "render_node/surface/face_grid.h"
#include "render_node/surface/limit_table.h"

namespace aquarama {

// Fills vertices, indices and bodyIndices of a table whose stencils are made.
void paintPlaces(const FishBody& body, const FaceGrid& grid, LimitTable& table);

}  // namespace aquarama
