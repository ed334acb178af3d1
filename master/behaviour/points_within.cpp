// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/points_within.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "master/behaviour/points_within.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "master/behaviour/sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::behaviour::HWY_NAMESPACE {

// Tests all points of the block of cells around the place, a vector at a time.
void takeVectorsWithin(
    const SpatialGrid& grid, glm::vec3 place, float reachSquared, TakePoints take, void* job) {
    // Enlarges the block by more than rounding can take off the reach.
    constexpr float kFarther = 1.001F;
    const glm::vec3 reach{std::sqrt(reachSquared) * kFarther};
    const SpatialGrid::Cell from = grid.cellOf(place - reach);
    const SpatialGrid::Cell to = grid.cellOf(place + reach);
    const OffsetLanes centre = everyLane(place.x, place.y, place.z);
    const Lanes farthest = hn::Set(kFloats, reachSquared);
    PointsWithin found;
    forRows(grid, from, to, [&](const SpatialGrid::Slots& slots, int, int) HWY_ATTR {
        sweep(slots.first, slots.last, [&](std::size_t slot, LaneMask there) HWY_ATTR {
            const OffsetLanes offset = offsetsFrom(centre, grid.x(), grid.y(), grid.z(), slot);
            const Lanes squared = dotLanes(offset, offset);
            const LaneMask near = hn::And(there, hn::Le(squared, farthest));
            const IndexLanes own = hn::Iota(kIndices, static_cast<std::uint32_t>(slot));
            append(kFloats, squared, near, found.distanceSquared.data() + found.count);
            append(kIndices, own, hn::RebindMask(kIndices, near), found.slot.data() + found.count);
            found.count += hn::CountTrue(kFloats, near);
            if (HWY_LIKELY(found.count < PointsWithin::kRoom)) return;
            take(job, found);
            found.count = 0;
        });
    });
    take(job, found);
}

}  // namespace aquarama::behaviour::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::behaviour {

HWY_EXPORT(takeVectorsWithin);

void takePointsWithin(
    const SpatialGrid& grid, glm::vec3 place, float reachSquared, TakePoints take, void* job) {
    assert(reachSquared >= 0);
    assert(take != nullptr);
    HWY_DYNAMIC_DISPATCH(takeVectorsWithin)(grid, place, reachSquared, take, job);
}

}  // namespace aquarama::behaviour
#endif
