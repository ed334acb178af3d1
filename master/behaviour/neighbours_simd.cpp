// SPDX-License-Identifier: Apache-2.0
// The vectorised search for neighbours: finds what nearestVisibleReference() finds, for as many
// fish at a time as a vector has lanes. Steps for one fish: guess a reach from the local density;
// collect all visible fish within it; if there are fewer than seven, repeat with a larger reach;
// rank the collected ones.
#include <algorithm>
#include <bit>
#include <cassert>

#include "master/behaviour/grids.h"
#include "master/behaviour/neighbours.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "master/behaviour/neighbours_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "master/behaviour/sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::behaviour::HWY_NAMESPACE {
namespace {

// With more fish than this the farther half is dropped before ranking, which is quadratic.
constexpr std::size_t kMostRanked = 32;
// Fish that a search collects before it reduces them to the nearest.
constexpr std::size_t kRoom = 256;
// The first guess of the reach is made for this many visible fish, so that there are seldom fewer
// than seven.
constexpr float kHopedFor = 14;
// Share of a ball that is in the field of view.
constexpr float kViewShare = 0.933F;
// A safety factor: rounding changes a distance to the border of a cell by less.
constexpr float kCertain = 0.999F;

// Fish collected so far, with room for a whole vector behind the last.
struct Kept {
    HWY_ALIGN float distanceSquared[kRoom + kMostLanes];
    HWY_ALIGN std::uint32_t fish[kRoom + kMostLanes];
    std::size_t count = 0;
};

// The plain way, one by one; used where ranking cannot decide.
void insertAll(const Kept& kept, Neighbours& nearest) {
    for (std::size_t i = 0; i < kept.count; ++i)
        nearest.insert(kept.fish[i], kept.distanceSquared[i]);
}

// Which lanes from i on hold a fish whose squared distance is at most the limit.
HWY_INLINE LaneMask notBeyond(const Kept& kept, std::size_t i, Lanes limit) {
    const LaneMask there = hn::FirstN(kFloats, kept.count - i);
    return hn::And(there, hn::Le(hn::Load(kFloats, kept.distanceSquared + i), limit));
}

// Drops the fish farther than the mean, if at least seven remain. False where that would drop too
// many or none.
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

// Ranks by counting, for each fish, how many are nearer: O(n^2), but vectorised and without
// branches. False where equal distances among the nearest leave their order open.
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

// The seven nearest of those collected.
Neighbours nearestOf(Kept& kept) {
    Neighbours nearest;
    while (kept.count > kMostRanked)
        if (!leaveOutFarther(kept)) break;
    if (kept.count <= kMostRanked && rank(kept, nearest)) return nearest;
    nearest = {};
    insertAll(kept, nearest);
    return nearest;
}

// List of vectors of slots to test: the first slot and the number of lanes in use. Made in advance,
// so that the loop over it has no branches.
struct Steps {
    static constexpr std::size_t kRoom = 64;
    std::uint32_t slot[kRoom + 1];
    std::uint32_t lanes[kRoom + 1];
    std::size_t count = 0;
};

// The values of the searching fish, in all lanes.
struct Search {
    const SpatialGrid* grid;
    glm::vec3 place;
    OffsetLanes position, heading;
    IndexLanes self, firstOfKind, countOfKind;

    // Tests the listed slots and adds the fish that are within the limit, in the field of view, and
    // of the own kind (kOwnKind) or of another. Empties the list.
    template <bool kOwnKind>
    HWY_INLINE void look(Steps& steps, float& limit, Kept& kept) const {
        const float* const x = grid->x();
        const float* const y = grid->y();
        const float* const z = grid->z();
        const std::uint32_t* const index = grid->index();
        const Lanes farthest = hn::Set(kFloats, limit);
        std::size_t count = kept.count;
        for (std::size_t i = 0; i < steps.count; ++i) {
            const std::size_t slot = steps.slot[i];
            const OffsetLanes offset = offsetsFrom(position, x, y, z, slot);
            const Lanes squared = dotLanes(offset, offset);
            const Lanes ahead = dotLanes(heading, offset);
            const IndexLanes fish = hn::LoadU(kIndices, index + slot);
            const LaneMask near =
                hn::And(hn::FirstN(kFloats, steps.lanes[i]), hn::Le(squared, farthest));
            const LaneMask seen =
                hn::Or(hn::Ge(ahead, hn::Zero(kFloats)),
                       hn::Le(hn::Mul(ahead, ahead),
                              hn::Mul(hn::Set(kFloats, kBlindCosineSquared), squared)));
            const auto own = hn::Lt(hn::Sub(fish, firstOfKind), countOfKind);
            const auto meant = kOwnKind ? hn::And(own, hn::Ne(fish, self)) : hn::Not(own);
            const LaneMask mask = hn::And(hn::And(near, seen), hn::RebindMask(kFloats, meant));
            append(kFloats, squared, mask, kept.distanceSquared + count);
            append(kIndices, fish, hn::RebindMask(kIndices, mask), kept.fish + count);
            count += hn::CountTrue(kFloats, mask);
            if (HWY_UNLIKELY(count > kRoom)) {
                kept.count = count;
                keepNearest(kept, limit);
                count = kept.count;
            }
        }
        kept.count = count;
        steps.count = 0;
    }

    // Reduces the fish collected to the nearest, and the limit to the farthest of them.
    static void keepNearest(Kept& kept, float& limit) {
        const Neighbours nearest = nearestOf(kept);
        kept.count = nearest.count;
        std::copy_n(nearest.fish.begin(), nearest.count, kept.fish);
        std::copy_n(nearest.distanceSquared.begin(), nearest.count, kept.distanceSquared);
        limit = std::min(limit, nearest.distanceSquared[nearest.count - 1]);
    }
};

// Lists a row of slots; tests those listed when the list is full.
template <bool kOwnKind>
HWY_INLINE void list(
    const Search& search, SpatialGrid::Slots slots, Steps& steps, float& limit, Kept& kept) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kFloats));
    // Without a branch for the common row, which one vector holds.
    steps.slot[steps.count] = slots.first;
    steps.lanes[steps.count] = slots.last - slots.first;
    steps.count += slots.last > slots.first ? 1 : 0;
    while (HWY_UNLIKELY(slots.last - slots.first > lanes)) {
        slots.first += lanes;
        if (steps.count == Steps::kRoom) search.look<kOwnKind>(steps, limit, kept);
        steps.slot[steps.count] = slots.first;
        steps.lanes[steps.count++] = slots.last - slots.first;
    }
    if (steps.count == Steps::kRoom) search.look<kOwnKind>(steps, limit, kept);
}

// Distance from a point to another row of cells along one axis, in cells. Border cells extend
// outwards without end.
HWY_INLINE float outside(float at, int own, int other) {
    const float beyond =
        other > own ? static_cast<float>(other) - at : at - static_cast<float>(other + 1);
    return other == own ? 0.0F : beyond;
}

// Collects all fish within reach, row by row of cells; only rows for which isMeant(from.x, to.x, y,
// z) holds.
template <bool kOwnKind, class IsMeant>
HWY_INLINE void lookWithin(const Search& search, float reach, const IsMeant& isMeant, Kept& kept) {
    const SpatialGrid& grid = *search.grid;
    const glm::vec3 wide{reach / kCertain};
    const SpatialGrid::Cell own = grid.cellOf(search.place);
    const SpatialGrid::Cell from = grid.cellOf(search.place - wide);
    const SpatialGrid::Cell to = grid.cellOf(search.place + wide);
    const glm::vec3 at = (search.place - grid.origin()) / grid.cellMetres();
    const float cells = wide.x / grid.cellMetres();
    float limit = reach * reach;
    Steps steps;
    kept.count = 0;
    for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y) {
            const float dy = outside(at.y, own.y, y);
            const float dz = outside(at.z, own.z, z);
            const bool meant = dy * dy + dz * dz <= cells * cells && isMeant(from.x, to.x, y, z);
            if (meant) list<kOwnKind>(search, grid.slotsOf(from.x, to.x, y, z), steps, limit, kept);
        }
    search.look<kOwnKind>(steps, limit, kept);
}

// A rough cube root, for the guess only. The bits of a float are roughly its logarithm, so dividing
// them by three takes the root.
HWY_INLINE float roughThirdRoot(float x) {
    constexpr std::uint64_t kBitsOfOne = 0x3f800000;
    const std::uint64_t bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(static_cast<std::uint32_t>((bits + 2 * kBitsOfOne) / 3));
}

// The 27 cells about a fish, fewer at the border of the grid: their rows, the number of fish in
// them, and the distance within which they hold every fish.
struct Block {
    SpatialGrid::Slots rows[9];
    int rowCount = 0;
    int cells;
    std::uint32_t fish = 0;
    // Metres: the block holds every fish within this distance.
    float reach;

    HWY_INLINE Block(const SpatialGrid& grid, glm::vec3 place) {
        const SpatialGrid::Cell most = grid.cells();
        const SpatialGrid::Cell at = grid.cellOf(place);
        const SpatialGrid::Cell from{
            std::max(at.x - 1, 0), std::max(at.y - 1, 0), std::max(at.z - 1, 0)};
        const SpatialGrid::Cell to{std::min(at.x + 1, most.x - 1),
                                   std::min(at.y + 1, most.y - 1),
                                   std::min(at.z + 1, most.z - 1)};
        cells = (to.x - from.x + 1) * (to.y - from.y + 1) * (to.z - from.z + 1);
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y) {
                const SpatialGrid::Slots slots = grid.slotsOf(from.x, to.x, y, z);
                fish += slots.last - slots.first;
                rows[rowCount++] = slots;
            }
        // The margin is negative for a fish outside the grid; then the reach may be 0.
        const glm::vec3 inCells = (place - grid.origin()) / grid.cellMetres();
        const auto margin = [](float in, int cell) {
            const float share = in - static_cast<float>(cell);
            return std::min(share, 1 - share);
        };
        const float least =
            std::min({margin(inCells.x, at.x), margin(inCells.y, at.y), margin(inCells.z, at.z)});
        reach = std::max(0.0F, (1 + least) * grid.cellMetres() * kCertain);
    }
};

// Reach within which kHopedFor fish are visible, if the density is that of the block.
HWY_INLINE float guess(const SpatialGrid& grid, const Block& block) {
    constexpr float kBall = 4.18879F;  // of radius 1
    const float cubed = kHopedFor * static_cast<float>(block.cells) /
                        (kBall * kViewShare * static_cast<float>(std::max(block.fish, 1U)));
    return roughThirdRoot(cubed) * grid.cellMetres();
}

// Collects the fish of the own kind in a block.
HWY_INLINE void lookInBlock(const Search& search, const Block& block, float reach, Kept& kept) {
    float limit = reach * reach;
    Steps steps;
    for (int row = 0; row < block.rowCount; ++row)
        list<true>(search, block.rows[row], steps, limit, kept);
    search.look<true>(steps, limit, kept);
}

// The nearest schoolmates: tries the block, then growing reaches up to kSightMetres, until there
// are seven.
HWY_INLINE Neighbours nearestOfKind(const Search& search) {
    // Share of the wanted reach that the block must cover: half of the volume.
    constexpr float kEnough = 0.8F;
    constexpr float kFarther = 1.5F;
    // In a dense school the reach is short, and most of the 27 cells would be tested without
    // result.
    constexpr float kFewOfACell = 0.7F;
    const auto everyRow = [](int, int, int, int) { return true; };
    Kept kept;
    const Block block(*search.grid, search.place);
    const float hoped = std::min(guess(*search.grid, block), kSightMetres);
    const bool isDense = hoped < kFewOfACell * search.grid->cellMetres();
    if (!isDense && block.reach >= kEnough * hoped) {
        lookInBlock(search, block, std::min(block.reach, hoped), kept);
        if (kept.count >= kMostNeighbours) return nearestOf(kept);
    }
    for (float reach = hoped;; reach = std::min(kFarther * reach, kSightMetres)) {
        lookWithin<true>(search, reach, everyRow, kept);
        if (kept.count >= kMostNeighbours || reach == kSightMetres) return nearestOf(kept);
    }
}

// The nearest of other species; usually a single test shows that there are none.
HWY_INLINE Neighbours nearestOthers(const Search& search,
                                    const KindsAbout& kinds,
                                    std::uint8_t own) {
    const SpatialGrid& grid = *search.grid;
    const glm::vec3 reach{kSightMetres / kCertain};
    const SpatialGrid::Cell from = grid.cellOf(search.place - reach);
    const SpatialGrid::Cell to = grid.cellOf(search.place + reach);
    if (!kinds.mayHoldOthers(from, to, own)) return {};
    Kept kept;
    lookWithin<false>(
        search,
        kSightMetres,
        [&](int firstX, int lastX, int y, int z) {
            const std::size_t row = grid.rowOf(y, z);
            return kinds.rowHoldsOthers(
                row + static_cast<std::size_t>(firstX), row + static_cast<std::size_t>(lastX), own);
        },
        kept);
    return nearestOf(kept);
}

}  // namespace

void nearestVisibleVectors(const fish::FishView& view,
                           const Grids& grids,
                           const fish::SpeciesParameters& parameters,
                           std::uint32_t fish,
                           NearestFish* nearest) {
    const glm::vec3 position = view.position(fish);
    const glm::vec3 heading = view.heading(fish);
    const Search search{&grids.fish,
                        position,
                        everyLane(position.x, position.y, position.z),
                        everyLane(heading.x, heading.y, heading.z),
                        hn::Set(kIndices, fish),
                        hn::Set(kIndices, parameters.first),
                        hn::Set(kIndices, parameters.last - parameters.first)};
    nearest->schoolmates = nearestOfKind(search);
    nearest->others = nearestOthers(search, grids.kinds, parameters.kind);
}

std::size_t lanes() {
    return hn::Lanes(kFloats);
}

}  // namespace aquarama::behaviour::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::behaviour {

HWY_EXPORT(nearestVisibleVectors);
HWY_EXPORT(lanes);

NearestFish nearestVisible(const fish::FishView& view,
                           const Grids& grids,
                           const fish::SpeciesParameters& parameters,
                           std::uint32_t fish) {
    NearestFish nearest;
    assert(fish < view.size());
    HWY_DYNAMIC_DISPATCH(nearestVisibleVectors)(view, grids, parameters, fish, &nearest);
    return nearest;
}

std::size_t nearestVisibleLanes() {
    return HWY_DYNAMIC_DISPATCH(lanes)();
}

}  // namespace aquarama::behaviour
#endif
