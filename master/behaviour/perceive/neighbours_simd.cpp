// SPDX-License-Identifier: Apache-2.0
// The vectorised search: what nearestVisibleReference() finds, of as many fish at a time as the
// processor has lanes.
#include <algorithm>
#include <bit>
#include <limits>

#include "master/behaviour/perceive/grids.h"
#include "master/behaviour/perceive/neighbours.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "master/behaviour/perceive/neighbours_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "master/behaviour/perceive/sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::HWY_NAMESPACE {
namespace {

// More than are worth ranking among one another: then the farther half is left out first.
constexpr std::size_t kMostRanked = 32;
constexpr std::size_t kRoom = 256;
// A first guess at how far the seven are is made for so many in view: seldom are there too few.
constexpr float kHopedFor = 14;
constexpr float kViewShare = 0.933F;  // of a ball that the field of view has
constexpr float kCertain = 0.999F;    // rounding takes less off a distance to a border
constexpr float kSightSquared = kSightMetres * kSightMetres;

// Those that a search has kept.
struct Kept {
    HWY_ALIGN float distanceSquared[kRoom + kMostLanes];
    HWY_ALIGN std::uint32_t fish[kRoom + kMostLanes];
    std::size_t count = 0;
};

void insertAll(const Kept& kept, Neighbours& nearest) {
    for (std::size_t i = 0; i < kept.count; ++i)
        nearest.insert(kept.fish[i], kept.distanceSquared[i]);
}

HWY_INLINE LaneMask notBeyond(const Kept& kept, std::size_t i, Lanes limit) {
    const LaneMask there = hn::FirstN(kFloats, kept.count - i);
    return hn::And(there, hn::Le(hn::Load(kFloats, kept.distanceSquared + i), limit));
}

// Leaves out those farther than the mean, if seven remain; false where that leaves out nobody.
HWY_INLINE bool leaveOutFarther(Kept& kept) {
    Lanes sum = hn::Zero(kFloats);
    sweep(0, kept.count, [&](std::size_t i, LaneMask there) HWY_ATTR {
        sum = hn::Add(sum, hn::IfThenElseZero(there, hn::Load(kFloats, kept.distanceSquared + i)));
    });
    const float mean = hn::GetLane(hn::SumOfLanes(kFloats, sum)) / static_cast<float>(kept.count);
    const Lanes limit = hn::Set(kFloats, mean);
    std::size_t near = 0;
    sweep(0, kept.count, [&](std::size_t i, LaneMask) HWY_ATTR {
        near += hn::CountTrue(kFloats, notBeyond(kept, i, limit));
    });
    if (near < kMostNeighbours || near == kept.count) return false;
    std::size_t end = 0;
    sweep(0, kept.count, [&](std::size_t i, LaneMask) HWY_ATTR {
        const LaneMask mask = notBeyond(kept, i, limit);
        const Lanes squared = hn::Load(kFloats, kept.distanceSquared + i);
        const IndexLanes fish = hn::Load(kIndices, kept.fish + i);
        hn::StoreU(hn::Compress(squared, mask), kFloats, kept.distanceSquared + end);
        hn::StoreU(hn::Compress(fish, hn::RebindMask(kIndices, mask)), kIndices, kept.fish + end);
        end += hn::CountTrue(kFloats, mask);
    });
    kept.count = end;
    return true;
}

// How many of all are nearer, for each; false where distances are equal among the nearest, so that
// places are not told by them alone.
HWY_INLINE bool rank(Kept& kept, Neighbours& nearest) {
    const auto wanted = static_cast<std::uint32_t>(std::min(kept.count, kMostNeighbours));
    std::size_t ranked = 0;
    HWY_ALIGN std::uint32_t places[kMostRanked + kMostLanes];
    HWY_ALIGN float squares[kMostRanked + kMostLanes];
    HWY_ALIGN std::uint32_t fish[kMostRanked + kMostLanes];
    sweep(0, kept.count, [&](std::size_t i, LaneMask there) HWY_ATTR {
        const Lanes squared = hn::Load(kFloats, kept.distanceSquared + i);
        IndexLanes place = hn::Zero(kIndices);
        for (std::size_t j = 0; j < kept.count; ++j) {
            const auto nearer = hn::Lt(hn::Set(kFloats, kept.distanceSquared[j]), squared);
            place = hn::Sub(place, hn::VecFromMask(kIndices, hn::RebindMask(kIndices, nearer)));
        }
        const auto among =
            hn::And(hn::RebindMask(kIndices, there), hn::Lt(place, hn::Set(kIndices, wanted)));
        append(kIndices, place, among, places + ranked);
        append(kFloats, squared, hn::RebindMask(kFloats, among), squares + ranked);
        append(kIndices, hn::Load(kIndices, kept.fish + i), among, fish + ranked);
        ranked += hn::CountTrue(kIndices, among);
    });
    if (ranked != wanted) return false;
    std::uint32_t taken = 0;
    for (std::uint32_t i = 0; i < wanted; ++i) {
        nearest.fish[places[i]] = fish[i];
        nearest.distanceSquared[places[i]] = squares[i];
        taken |= 1U << places[i];
    }
    nearest.count = wanted;
    return taken == (1U << wanted) - 1;
}

Neighbours nearestOf(Kept& kept) {
    Neighbours nearest;
    while (kept.count > kMostRanked)
        if (!leaveOutFarther(kept)) break;
    if (kept.count <= kMostRanked && rank(kept, nearest)) return nearest;
    nearest = {};
    insertAll(kept, nearest);
    return nearest;
}

struct Search {
    const SpatialGrid* grid;
    glm::vec3 place;
    OffsetLanes position, heading;
    IndexLanes self, firstOfKind, countOfKind;

    // Adds to those kept who stand in these slots, are in view and within the limit, and of its own
    // kind or not.
    template <bool kOwnKind>
    HWY_INLINE void look(const SpatialGrid::Slots& slots, float& limit, Kept& kept) const {
        const float* const x = grid->x();
        const float* const y = grid->y();
        const float* const z = grid->z();
        const std::uint32_t* const index = grid->index();
        sweep(slots.first, slots.last, [&](std::size_t slot, LaneMask there) HWY_ATTR {
            const OffsetLanes offset = offsetsFrom(position, x, y, z, slot);
            const Lanes squared = dotLanes(offset, offset);
            const Lanes ahead = dotLanes(heading, offset);
            const IndexLanes fish = hn::LoadU(kIndices, index + slot);
            const LaneMask near = hn::And(there, hn::Le(squared, hn::Set(kFloats, limit)));
            const LaneMask seen =
                hn::Or(hn::Ge(ahead, hn::Zero(kFloats)),
                       hn::Le(hn::Mul(ahead, ahead),
                              hn::Mul(hn::Set(kFloats, kBlindCosineSquared), squared)));
            const auto own = hn::Lt(hn::Sub(fish, firstOfKind), countOfKind);
            const auto meant = kOwnKind ? hn::And(own, hn::Ne(fish, self)) : hn::Not(own);
            const LaneMask mask = hn::And(hn::And(near, seen), hn::RebindMask(kFloats, meant));
            append(kFloats, squared, mask, kept.distanceSquared + kept.count);
            append(kIndices, fish, hn::RebindMask(kIndices, mask), kept.fish + kept.count);
            kept.count += hn::CountTrue(kFloats, mask);
            if (HWY_UNLIKELY(kept.count > kRoom)) keepNearest(kept, limit);
        });
    }

    static void keepNearest(Kept& kept, float& limit) {
        const Neighbours nearest = nearestOf(kept);
        kept.count = nearest.count;
        std::copy_n(nearest.fish.begin(), nearest.count, kept.fish);
        std::copy_n(nearest.distanceSquared.begin(), nearest.count, kept.distanceSquared);
        limit = nearest.distanceSquared[nearest.count - 1];
    }
};

// A cube of cells about a fish, cut off where the grid ends.
struct Block {
    SpatialGrid::Cell from, to;
    float reach;  // metres: as far it holds all
};

// Cells at the border of the grid reach outwards without end.
HWY_INLINE float cellsToBorder(float at, int from, int to, int cells) {
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    const float below = from > 0 ? at - static_cast<float>(from) : kEndless;
    const float above = to < cells - 1 ? static_cast<float>(to + 1) - at : kEndless;
    return std::min(below, above);
}

HWY_INLINE Block blockAround(const SpatialGrid& grid, glm::vec3 place, int shells) {
    const SpatialGrid::Cell cells = grid.cells();
    const SpatialGrid::Cell at = grid.cellOf(place);
    const auto upTo = [shells](int cell, int last) { return std::min(cell + shells, last - 1); };
    const auto downTo = [shells](int cell) { return std::max(cell - shells, 0); };
    Block block{{downTo(at.x), downTo(at.y), downTo(at.z)},
                {upTo(at.x, cells.x), upTo(at.y, cells.y), upTo(at.z, cells.z)},
                0};
    const glm::vec3 inCells = (place - grid.origin()) / grid.cellMetres();
    const float border = std::min({cellsToBorder(inCells.x, block.from.x, block.to.x, cells.x),
                                   cellsToBorder(inCells.y, block.from.y, block.to.y, cells.y),
                                   cellsToBorder(inCells.z, block.from.z, block.to.z, cells.z)});
    block.reach = std::min(border * grid.cellMetres() * kCertain, kSightMetres);
    return block;
}

// x to the power of 2/3, near enough for a guess: a third is taken of the logarithm that the bits
// of a float nearly are.
HWY_INLINE float roughlyTwoThirdsPower(float x) {
    constexpr std::uint64_t kBitsOfOne = 0x3f800000;
    const std::uint64_t bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(static_cast<std::uint32_t>((2 * bits + kBitsOfOne) / 3));
}

std::size_t fishIn(const SpatialGrid& grid, const Block& block) {
    std::size_t fish = 0;
    forRows(grid, block.from, block.to, [&](const SpatialGrid::Slots& slots, int, int) {
        fish += slots.last - slots.first;
    });
    return fish;
}

// The square of about how far the hoped for are, where so many fish share a block.
HWY_INLINE float guess(const SpatialGrid& grid, const Block& block, std::size_t fish) {
    const auto cells =
        static_cast<float>((block.to.x - block.from.x + 1) * (block.to.y - block.from.y + 1) *
                           (block.to.z - block.from.z + 1));
    constexpr float kBall = 4.18879F;  // of radius 1
    const float cubed = kHopedFor * cells / (kBall * kViewShare * static_cast<float>(fish));
    return roughlyTwoThirdsPower(cubed) * grid.cellMetres() * grid.cellMetres();
}

HWY_INLINE void lookAt(const Search& search, const Block& block, float limit, Kept& kept) {
    kept.count = 0;
    forRows(*search.grid, block.from, block.to, [&](const SpatialGrid::Slots& slots, int, int) {
        search.look<true>(slots, limit, kept);
    });
}

// In growing shells of cells, until seven are found that nobody beyond can be nearer than.
HWY_INLINE Neighbours nearestOfKind(const Search& search) {
    Kept kept;
    for (int shells = 1;; ++shells) {
        const Block block = blockAround(*search.grid, search.place, shells);
        const std::size_t fish = fishIn(*search.grid, block);
        const bool all = block.reach >= kSightMetres;
        if (fish <= kMostNeighbours && !all) continue;
        const float guessed = guess(*search.grid, block, fish);
        const float reachSquared = all ? kSightSquared : block.reach * block.reach;
        lookAt(search, block, std::min(guessed, reachSquared), kept);
        if (kept.count < kMostNeighbours && guessed < reachSquared)
            lookAt(search, block, reachSquared, kept);
        if (kept.count >= kMostNeighbours || all) return nearestOf(kept);
    }
}

HWY_INLINE Neighbours nearestOthers(const Search& search,
                                    const KindsAbout& kinds,
                                    std::uint8_t own) {
    const SpatialGrid& grid = *search.grid;
    const glm::vec3 reach{kSightMetres / kCertain};
    const SpatialGrid::Cell from = grid.cellOf(search.place - reach);
    const SpatialGrid::Cell to = grid.cellOf(search.place + reach);
    if (!kinds.mayHoldOthers(from, to, own)) return {};
    Kept kept;
    float limit = kSightSquared;
    forRows(grid, from, to, [&](const SpatialGrid::Slots& slots, int y, int z) {
        const auto at = [&](int x) { return grid.rowOf(y, z) + static_cast<std::size_t>(x); };
        if (kinds.rowHoldsOthers(at(from.x), at(to.x), own)) search.look<false>(slots, limit, kept);
    });
    return nearestOf(kept);
}

}  // namespace

void nearestVisibleVectors(const FishView& view,
                           const Grids& grids,
                           const Nature& nature,
                           std::uint32_t fish,
                           NearestFish* nearest) {
    const glm::vec3 position = view.position(fish);
    const glm::vec3 heading = view.heading(fish);
    const Search search{&grids.fish,
                        position,
                        everyLane(position.x, position.y, position.z),
                        everyLane(heading.x, heading.y, heading.z),
                        hn::Set(kIndices, fish),
                        hn::Set(kIndices, nature.first),
                        hn::Set(kIndices, nature.last - nature.first)};
    nearest->schoolmates = nearestOfKind(search);
    nearest->others = nearestOthers(search, grids.kinds, nature.kind);
}

std::size_t lanes() {
    return hn::Lanes(kFloats);
}

}  // namespace aquarama::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama {

HWY_EXPORT(nearestVisibleVectors);
HWY_EXPORT(lanes);

NearestFish nearestVisible(const FishView& view,
                           const Grids& grids,
                           const Nature& nature,
                           std::uint32_t fish) {
    NearestFish nearest;
    HWY_DYNAMIC_DISPATCH(nearestVisibleVectors)(view, grids, nature, fish, &nearest);
    return nearest;
}

std::size_t nearestVisibleLanes() {
    return HWY_DYNAMIC_DISPATCH(lanes)();
}

}  // namespace aquarama
#endif
