// SPDX-License-Identifier: Apache-2.0
// Searching a sparse grid: where it holds few points it is quicker to look at them all.
#pragma once

#include <glm/vec3.hpp>

#include "master/behaviour/perceive/spatial_grid.h"

namespace aquarama {

// As SpatialGrid::visitAround.
template <class Visit>
void visitSparse(const SpatialGrid& grid,
                 std::size_t few,
                 glm::vec3 point,
                 const float& reachSquared,
                 const Visit& visit) {
    const std::size_t size = grid.size();
    if (size > few) return grid.visitAround(point, reachSquared, visit);
    if (size > 0)
        visit(SpatialGrid::Candidates{
            {grid.x(), size}, {grid.y(), size}, {grid.z(), size}, {grid.index(), size}});
}

}  // namespace aquarama
