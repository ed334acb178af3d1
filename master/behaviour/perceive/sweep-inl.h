// SPDX-License-Identifier: Apache-2.0
// Goes over the points that are near, as many at a time as the processor has lanes. What is done
// with them is a rule: a functor of a vector of points and a mask of those that are meant.

// Included once for each instruction set.
#if defined(AQUARAMA_SWEEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AQUARAMA_SWEEP_INL_H
#undef AQUARAMA_SWEEP_INL_H
#else
#define AQUARAMA_SWEEP_INL_H
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "master/behaviour/perceive/spatial_grid.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::behaviour::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kMostLanes>;
using Indices = hn::RebindToUnsigned<Floats>;
using Lanes = hn::Vec<Floats>;
using IndexLanes = hn::Vec<Indices>;
using LaneMask = hn::Mask<Floats>;
constexpr Floats kFloats;
constexpr Indices kIndices;

struct OffsetLanes {
    Lanes x, y, z;
};

// In the order of dot() in angle.h, so that every width gives the same bits.
HWY_INLINE Lanes dotLanes(const OffsetLanes& a, const OffsetLanes& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE OffsetLanes offsetsFrom(
    const OffsetLanes& from, const float* x, const float* y, const float* z, std::size_t slot) {
    return {hn::Sub(hn::LoadU(kFloats, x + slot), from.x),
            hn::Sub(hn::LoadU(kFloats, y + slot), from.y),
            hn::Sub(hn::LoadU(kFloats, z + slot), from.z)};
}

HWY_INLINE OffsetLanes everyLane(float x, float y, float z) {
    return {hn::Set(kFloats, x), hn::Set(kFloats, y), hn::Set(kFloats, z)};
}

// rule(slot, mask) for the vectors of slots [first, last); behind `last` a whole vector is
// readable.
template <class Rule>
HWY_INLINE void sweep(std::size_t first, std::size_t last, const Rule& rule) {
    for (std::size_t slot = first; slot < last; slot += hn::Lanes(kFloats))
        rule(slot, hn::FirstN(kFloats, last - slot));
}

// The rows of a block of cells that hold any point, as runs of slots: rule(slots, y, z).
template <class Rule>
HWY_INLINE void forRows(const SpatialGrid& grid,
                        const SpatialGrid::Cell& from,
                        const SpatialGrid::Cell& to,
                        const Rule& rule) {
    for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y) {
            const SpatialGrid::Slots slots = grid.slotsOf(from.x, to.x, y, z);
            if (slots.first < slots.last) rule(slots, y, z);
        }
}

// Appends the lanes of a mask, moved together; behind them a whole vector is written.
template <class Tag>
HWY_INLINE void append(Tag tag, hn::Vec<Tag> lanes, hn::Mask<Tag> mask, hn::TFromD<Tag>* end) {
    hn::StoreU(hn::Compress(lanes, mask), tag, end);
}

// Where a whole cell thinks, what is near it is gathered once for all who are in it: so many
// columns of the points, the first three of them x, y and z.
template <std::size_t kColumns>
struct Gathered {
    static constexpr std::size_t kRoom = 4096;
    HWY_ALIGN float columns[kColumns][kRoom + 2 * kMostLanes];
    std::size_t count = 0;

    // rule(i) for the vectors [i, i + lanes). Whatever makes up the last one is far from all.
    template <class Rule>
    HWY_INLINE void forEach(const Rule& rule) const {
        for (std::size_t i = 0; i < count; i += hn::Lanes(kFloats)) rule(i);
    }
};

// The smallest box about some points.
struct TightBox {
    OffsetLanes low, high;

    // How far points are from it, squared.
    HWY_INLINE Lanes squaredDistance(Lanes x, Lanes y, Lanes z) const {
        const auto outside = [](Lanes at, Lanes least, Lanes most) HWY_ATTR {
            return hn::Max(hn::Max(hn::Sub(least, at), hn::Sub(at, most)), hn::Zero(kFloats));
        };
        const OffsetLanes gap{
            outside(x, low.x, high.x), outside(y, low.y, high.y), outside(z, low.z, high.z)};
        return dotLanes(gap, gap);
    }
};

HWY_INLINE TightBox boxAround(const float* const* columns, const SpatialGrid::Slots& slots) {
    float low[3];
    float high[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [least, most] =
            std::minmax_element(columns[axis] + slots.first, columns[axis] + slots.last);
        low[axis] = *least;
        high[axis] = *most;
    }
    return {everyLane(low[0], low[1], low[2]), everyLane(high[0], high[1], high[2])};
}

// All within reach of the points of a cell, whose width is the reach at least. Those beyond the
// room are left out.
template <std::size_t kColumns>
HWY_INLINE void gatherAround(const SpatialGrid& grid,
                             const SpatialGrid::Cell& cell,
                             const SpatialGrid::Slots& own,
                             float reach,
                             const float* const* columns,
                             Gathered<kColumns>& near) {
    constexpr float kFarAway = 1e6F;
    const TightBox box = boxAround(columns, own);
    const Lanes reachSquared = hn::Set(kFloats, reach * reach);
    const SpatialGrid::Cell cells = grid.cells();
    const SpatialGrid::Cell from{
        std::max(cell.x - 1, 0), std::max(cell.y - 1, 0), std::max(cell.z - 1, 0)};
    const SpatialGrid::Cell to{std::min(cell.x + 1, cells.x - 1),
                               std::min(cell.y + 1, cells.y - 1),
                               std::min(cell.z + 1, cells.z - 1)};
    std::size_t count = 0;
    forRows(grid, from, to, [&](const SpatialGrid::Slots& slots, int, int) HWY_ATTR {
        sweep(slots.first, slots.last, [&](std::size_t slot, LaneMask there) HWY_ATTR {
            const Lanes x = hn::LoadU(kFloats, columns[0] + slot);
            const Lanes y = hn::LoadU(kFloats, columns[1] + slot);
            const Lanes z = hn::LoadU(kFloats, columns[2] + slot);
            const LaneMask mask =
                hn::And(there, hn::Le(box.squaredDistance(x, y, z), reachSquared));
            append(kFloats, x, mask, near.columns[0] + count);
            append(kFloats, y, mask, near.columns[1] + count);
            append(kFloats, z, mask, near.columns[2] + count);
            for (std::size_t i = 3; i < kColumns; ++i)
                append(
                    kFloats, hn::LoadU(kFloats, columns[i] + slot), mask, near.columns[i] + count);
            count = std::min(count + hn::CountTrue(kFloats, mask), Gathered<kColumns>::kRoom);
        });
    });
    for (std::size_t i = 0; i < kColumns; ++i)
        hn::StoreU(hn::Set(kFloats, kFarAway), kFloats, near.columns[i] + count);
    near.count = count;
}

// The cells that hold any point, in the order of their slots: rule(cell, slots).
template <class Rule>
HWY_INLINE void forCells(const SpatialGrid& grid, const Rule& rule) {
    const SpatialGrid::Cell cells = grid.cells();
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const SpatialGrid::Slots slots = grid.slotsOf(x, x, y, z);
                if (slots.first < slots.last) rule(SpatialGrid::Cell{x, y, z}, slots);
            }
}

}  // namespace
}  // namespace aquarama::behaviour::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
