// SPDX-License-Identifier: Apache-2.0
// Loops over points near a place, as many at a time as a vector has lanes. What is done with them
// is a rule: a functor of a vector of slots and a mask of those meant.

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

// One vector in space for each lane.
struct OffsetLanes {
    Lanes x, y, z;
};

// Adds in the order of place::dot(), so that every width of vectors gives the same bits.
HWY_INLINE Lanes dotLanes(const OffsetLanes& a, const OffsetLanes& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

// Offsets to the points of the next slots; reads a whole vector.
HWY_INLINE OffsetLanes offsetsFrom(
    const OffsetLanes& from, const float* x, const float* y, const float* z, std::size_t slot) {
    return {hn::Sub(hn::LoadU(kFloats, x + slot), from.x),
            hn::Sub(hn::LoadU(kFloats, y + slot), from.y),
            hn::Sub(hn::LoadU(kFloats, z + slot), from.z)};
}

HWY_INLINE OffsetLanes everyLane(float x, float y, float z) {
    return {hn::Set(kFloats, x), hn::Set(kFloats, y), hn::Set(kFloats, z)};
}

// Calls rule(slot, mask) for the vectors of slots [first, last); a whole vector behind `last` is
// readable.
template <class Rule>
HWY_INLINE void sweep(std::size_t first, std::size_t last, const Rule& rule) {
    for (std::size_t slot = first; slot < last; slot += hn::Lanes(kFloats))
        rule(slot, hn::FirstN(kFloats, last - slot));
}

// Calls rule(slots, y, z) for each row of a block of cells that holds any point.
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

// Appends the masked lanes, compressed; a whole vector is written at `end`.
template <class Tag>
HWY_INLINE void append(Tag tag, hn::Vec<Tag> lanes, hn::Mask<Tag> mask, hn::TFromD<Tag>* end) {
    hn::StoreU(hn::Compress(lanes, mask), tag, end);
}

}  // namespace
}  // namespace aquarama::behaviour::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
