// SPDX-License-Identifier: Apache-2.0
// Visits all points of a grid within reach of a place, by vectors. For searches that look at each
// of them in any case.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "master/behaviour/grids.h"

namespace aquarama::behaviour {

// A batch of points: their slots in the grid and squared distances. Behind kRoom a vector may be
// written.
struct PointsWithin {
    static constexpr std::size_t kRoom = 64;
    std::array<std::uint32_t, kRoom + kMostLanes> slot;
    std::array<float, kRoom + kMostLanes> distanceSquared;
    std::size_t count = 0;
};

// Calls take(job, points) with batches until all points were taken; a batch may be empty.
using TakePoints = void (*)(void* job, const PointsWithin& points);
void takePointsWithin(
    const SpatialGrid& grid, glm::vec3 place, float reachSquared, TakePoints take, void* job);

// Calls visit(index, offset, distanceSquared) for each point; offset leads from the place to it.
template <class Visit>
void visitPointsWithin(const SpatialGrid& grid, glm::vec3 place, float reachSquared, Visit visit) {
    struct Job {
        const SpatialGrid& grid;
        glm::vec3 place;
        Visit& visit;
    } job{grid, place, visit};
    const auto take = [](void* of, const PointsWithin& points) {
        const Job& whole = *static_cast<const Job*>(of);
        for (std::size_t i = 0; i < points.count; ++i) {
            const std::uint32_t slot = points.slot[i];
            const glm::vec3 at{whole.grid.x()[slot], whole.grid.y()[slot], whole.grid.z()[slot]};
            whole.visit(whole.grid.index()[slot], at - whole.place, points.distanceSquared[i]);
        }
    };
    takePointsWithin(grid, place, reachSquared, take, &job);
}

}  // namespace aquarama::behaviour
