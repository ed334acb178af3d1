// SPDX-License-Identifier: Apache-2.0
// All points of a grid within reach of a place, found by vectors: for a search that looks at each
// of them anyhow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "master/behaviour/grids.h"

namespace aquarama::behaviour {

// Slots of the grid, and how far off they are.
struct PointsWithin {
    static constexpr std::size_t kRoom = 64;
    std::array<std::uint32_t, kRoom + kMostLanes> slot;
    std::array<float, kRoom + kMostLanes> distanceSquared;
    std::size_t count = 0;
};

// Calls take(job, points) with some of them at a time, until all were taken.
using TakePoints = void (*)(void* job, const PointsWithin& points);
void takePointsWithin(
    const SpatialGrid& grid, glm::vec3 place, float reachSquared, TakePoints take, void* job);

// visit(index, offset, distanceSquared) for each.
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
