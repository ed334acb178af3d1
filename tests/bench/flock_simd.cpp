// SPDX-License-Identifier: Apache-2.0
// OpenSteer's rules on vectors of candidates.
#include <algorithm>
#include <limits>

#include "tests/bench/flock.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/flock_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "master/behaviour/perceive/sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::bench::HWY_NAMESPACE {
namespace {

using namespace behaviour::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): sweep-inl.h

constexpr std::size_t kBlockBoids = 64;
constexpr std::size_t kSums = 9;  // of separation, alignment and cohesion
constexpr float kTiniest = 1e-20F;

// Sums of a block of boids, each as four parts; and the number of those that it is aligned with.
struct Sums {
    HWY_ALIGN float fours[kSums][4 * kBlockBoids];
    HWY_ALIGN float aligned[kBlockBoids];
};

// The lanes of a vector, added up to four.
template <class Tag>
HWY_INLINE void storeFour(Tag tag, hn::Vec<Tag> lanes, float* four) {
#if HWY_TARGET == HWY_SCALAR
    std::fill_n(four, 4, 0.0F);
    hn::Store(lanes, tag, four);
#else
    if constexpr (hn::MaxLanes(Tag()) > 4) {
        const hn::Half<Tag> half;
        storeFour(half, hn::Add(hn::UpperHalf(half, lanes), hn::LowerHalf(half, lanes)), four);
    } else {
        hn::Store(lanes, tag, four);
    }
#endif
}

HWY_INLINE Lanes masked(LaneMask mask, Lanes lanes) {
    return hn::IfThenElseZero(mask, lanes);
}

// What boid `slot` sees of those gathered. It is one of them itself: at no offset, it adds nothing
// to separation and cohesion, and to alignment its own heading, of which as much is taken off.
template <class Gathered>
HWY_INLINE void see(
    const Flock& flock, const Gathered& near, std::size_t slot, Sums& sums, std::size_t at) {
    const OffsetLanes from =
        everyLane(flock[Flock::X][slot], flock[Flock::Y][slot], flock[Flock::Z][slot]);
    const OffsetLanes heading = everyLane(
        flock[Flock::HeadingX][slot], flock[Flock::HeadingY][slot], flock[Flock::HeadingZ][slot]);
    const Lanes zero = hn::Zero(kFloats);
    const Lanes one = hn::Set(kFloats, 1.0F);
    Lanes sum[kSums] = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
    std::size_t aligned = 0;
    near.forEach([&](std::size_t i) HWY_ATTR {
        const OffsetLanes offset =
            offsetsFrom(from, near.columns[0], near.columns[1], near.columns[2], i);
        const Lanes squared = hn::Max(
            hn::MulAdd(
                offset.x, offset.x, hn::MulAdd(offset.y, offset.y, hn::Mul(offset.z, offset.z))),
            hn::Set(kFloats, kTiniest));
        const Lanes inverse = hn::ApproximateReciprocalSqrt(squared);
        const Lanes ahead = hn::MulAdd(
            heading.x, offset.x, hn::MulAdd(heading.y, offset.y, hn::Mul(heading.z, offset.z)));
        const auto within = [&](float reach) HWY_ATTR {
            return hn::Le(squared, hn::Set(kFloats, reach * reach));
        };
        const Lanes cosine =
            hn::IfThenElse(hn::Lt(squared, hn::Set(kFloats, kAlwaysNear * kAlwaysNear)),
                           one,
                           hn::Mul(ahead, inverse));
        const auto inView = [&](float least)
                                HWY_ATTR { return hn::Gt(cosine, hn::Set(kFloats, least)); };
        const LaneMask parts = hn::And(within(kSeparationReach), inView(kSeparationCosine));
        const LaneMask aligns = hn::And(within(kAlignmentReach), inView(kAlignmentCosine));
        const LaneMask draws = hn::And(within(kCohesionReach), inView(kCohesionCosine));
        const Lanes nearness = masked(parts, hn::Mul(inverse, inverse));
        const Lanes alignment = masked(aligns, one);
        const Lanes cohesion = masked(draws, one);
        sum[0] = hn::NegMulAdd(offset.x, nearness, sum[0]);
        sum[1] = hn::NegMulAdd(offset.y, nearness, sum[1]);
        sum[2] = hn::NegMulAdd(offset.z, nearness, sum[2]);
        sum[3] = hn::MulAdd(hn::Load(kFloats, near.columns[3] + i), alignment, sum[3]);
        sum[4] = hn::MulAdd(hn::Load(kFloats, near.columns[4] + i), alignment, sum[4]);
        sum[5] = hn::MulAdd(hn::Load(kFloats, near.columns[5] + i), alignment, sum[5]);
        sum[6] = hn::MulAdd(offset.x, cohesion, sum[6]);
        sum[7] = hn::MulAdd(offset.y, cohesion, sum[7]);
        sum[8] = hn::MulAdd(offset.z, cohesion, sum[8]);
        aligned += hn::CountTrue(kFloats, aligns);
    });
    for (std::size_t i = 0; i < kSums; ++i) storeFour(kFloats, sum[i], sums.fours[i] + 4 * at);
    sums.aligned[at] = static_cast<float>(aligned);
}

// 1 / sqrt, by one step of Newton's after the processor's guess.
HWY_INLINE Lanes inverseRoot(Lanes value) {
    const Lanes guess = hn::ApproximateReciprocalSqrt(value);
    const Lanes half = hn::Mul(hn::Set(kFloats, 0.5F), value);
    return hn::Mul(guess, hn::NegMulAdd(half, hn::Mul(guess, guess), hn::Set(kFloats, 1.5F)));
}

HWY_INLINE Lanes squareOf(const OffsetLanes& v) {
    return hn::Max(dotLanes(v, v), hn::Set(kFloats, kTiniest));
}

HWY_INLINE OffsetLanes times(const OffsetLanes& v, Lanes factor) {
    return {hn::Mul(v.x, factor), hn::Mul(v.y, factor), hn::Mul(v.z, factor)};
}

HWY_INLINE OffsetLanes plus(const OffsetLanes& a, const OffsetLanes& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

// Of this length; as it is where there is none.
HWY_INLINE OffsetLanes withLength(const OffsetLanes& v, float length) {
    return times(v, hn::Mul(hn::Set(kFloats, length), inverseRoot(squareOf(v))));
}

HWY_INLINE OffsetLanes truncated(const OffsetLanes& v, float most) {
    const Lanes factor = hn::Mul(hn::Set(kFloats, most), inverseRoot(squareOf(v)));
    return times(v, hn::Min(factor, hn::Set(kFloats, 1.0F)));
}

HWY_INLINE Lanes addedUp(const float* fours) {
    Lanes a, b, c, d;
    hn::LoadInterleaved4(kFloats, fours, a, b, c, d);
    return hn::Add(hn::Add(a, b), hn::Add(c, d));
}

HWY_INLINE OffsetLanes addedUp(const Sums& sums, std::size_t first, std::size_t lane) {
    return {addedUp(sums.fours[first] + 4 * lane),
            addedUp(sums.fours[first + 1] + 4 * lane),
            addedUp(sums.fours[first + 2] + 4 * lane)};
}

HWY_INLINE OffsetLanes loadLanes(const Flock& flock, std::size_t first, std::size_t slot) {
    const auto at = [&](std::size_t column) HWY_ATTR {
        return hn::LoadU(kFloats, flock.columns[first + column].data() + slot);
    };
    return {at(0), at(1), at(2)};
}

HWY_INLINE void storeLanes(const OffsetLanes& v,
                           Flock& flock,
                           std::size_t first,
                           std::size_t slot) {
    hn::StoreU(v.x, kFloats, flock.columns[first].data() + slot);
    hn::StoreU(v.y, kFloats, flock.columns[first + 1].data() + slot);
    hn::StoreU(v.z, kFloats, flock.columns[first + 2].data() + slot);
}

// Steering force, velocity and motion of boids [slot, slot + lanes) from their sums.
HWY_INLINE void swim(const FlockThoughts& thoughts,
                     const Sums& sums,
                     std::size_t lane,
                     std::size_t slot) {
    const Flock& flock = *thoughts.sorted;
    const OffsetLanes heading = loadLanes(flock, Flock::HeadingX, slot);
    const Lanes aligned = hn::Load(kFloats, sums.aligned + lane);
    const OffsetLanes alignment = plus(addedUp(sums, 3, lane), times(heading, hn::Neg(aligned)));
    const OffsetLanes force = truncated(plus(withLength(addedUp(sums, 0, lane), kSeparation),
                                             plus(withLength(alignment, kAlignment),
                                                  withLength(addedUp(sums, 6, lane), kCohesion))),
                                        kMostForce);
    const Lanes seconds = hn::Set(kFloats, kFlockSeconds);
    const OffsetLanes velocity = truncated(
        plus(times(heading, hn::LoadU(kFloats, flock[Flock::Speed] + slot)), times(force, seconds)),
        kMostSpeed);
    OffsetLanes position = plus(loadLanes(flock, Flock::X, slot), times(velocity, seconds));
    const Lanes squared = squareOf(position);
    const Lanes radius = hn::Set(kFloats, thoughts.radius);
    const Lanes back = hn::IfThenElse(
        hn::Gt(squared, hn::Mul(radius, radius)),
        hn::NegMulAdd(hn::Add(radius, radius), inverseRoot(squared), hn::Set(kFloats, 1.0F)),
        hn::Set(kFloats, 1.0F));
    position = times(position, back);
    storeLanes(position, *thoughts.next, Flock::X, slot);
    const Lanes square = squareOf(velocity);
    const Lanes inverse = inverseRoot(square);
    storeLanes(times(velocity, inverse), *thoughts.next, Flock::HeadingX, slot);
    hn::StoreU(hn::Mul(square, inverse), kFloats, (*thoughts.next)[Flock::Speed] + slot);
}

}  // namespace

void think(const FlockThoughts& thoughts) {
    static thread_local Gathered<6> near;
    const Flock& flock = *thoughts.sorted;
    const float* const columns[6] = {flock[Flock::X],
                                     flock[Flock::Y],
                                     flock[Flock::Z],
                                     flock[Flock::HeadingX],
                                     flock[Flock::HeadingY],
                                     flock[Flock::HeadingZ]};
    Sums sums;
    std::size_t first = 0;  // of the block
    const auto finish = [&](std::size_t last) HWY_ATTR {
        for (std::size_t slot = first; slot < last; slot += hn::Lanes(kFloats))
            swim(thoughts, sums, slot - first, slot);
        first = last;
    };
    forCells(*thoughts.grid,
             [&](const behaviour::SpatialGrid::Cell& cell, const behaviour::SpatialGrid::Slots& own)
                 HWY_ATTR {
                     gatherAround(*thoughts.grid, cell, own, kFlockReach, columns, near);
                     for (std::size_t slot = own.first; slot < own.last; ++slot) {
                         if (slot - first == kBlockBoids) finish(slot);
                         see(flock, near, slot, sums, slot - first);
                     }
                 });
    finish(flock.size());
}

}  // namespace aquarama::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::bench {

HWY_EXPORT(think);

void FlockStep::run(Flock& flock) {
    sort(flock);
    HWY_DYNAMIC_DISPATCH(think)({&grid_, &sorted_, &flock, radius_});
}

}  // namespace aquarama::bench
#endif
