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

#include "master/behaviour/grids.h"

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

}  // namespace
}  // namespace aquarama::behaviour::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
