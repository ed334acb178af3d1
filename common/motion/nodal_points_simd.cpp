// SPDX-License-Identifier: Apache-2.0
// Eq. 12 on as many nodal points of a fish at a time as the processor has lanes. Multiplications
// and additions are in one order and never fused: the same bits on any instruction set.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/motion/motor_tables.h"
#include "common/motion/reconstruct.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/nodal_points_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/motion/motor_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::motion::HWY_NAMESPACE {
namespace {

// Writes lanes of x, y and z as points. Of the three vectors that come of it, vector j holds in
// lane l the coordinate (j N + l) mod 3 of point (j N + l) / 3.
class Interleave {
  public:
    HWY_INLINE Interleave() {
        const std::size_t lanes = hn::Lanes(kFloats);
        HWY_ALIGN std::int32_t point[kWidestLanes];
        HWY_ALIGN std::int32_t axis[kWidestLanes];
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t l = 0; l < lanes; ++l) {
                point[l] = static_cast<std::int32_t>((j * lanes + l) / 3);
                axis[l] = static_cast<std::int32_t>((j * lanes + l) % 3);
            }
            point_[j] = hn::SetTableIndices(kFloats, point);
            const auto axes = hn::Load(kInts, axis);
            isY_[j] = hn::RebindMask(kFloats, hn::Eq(axes, hn::Set(kInts, 1)));
            isZ_[j] = hn::RebindMask(kFloats, hn::Eq(axes, hn::Set(kInts, 2)));
        }
    }
    HWY_INLINE void store(const VectorLanes& v, float* points) const {
        for (std::size_t j = 0; j < 3; ++j) {
            Lanes out = hn::TableLookupLanes(v.x, point_[j]);
            out = hn::IfThenElse(isY_[j], hn::TableLookupLanes(v.y, point_[j]), out);
            out = hn::IfThenElse(isZ_[j], hn::TableLookupLanes(v.z, point_[j]), out);
            hn::StoreU(out, kFloats, points + j * hn::Lanes(kFloats));
        }
    }

  private:
    using Places = decltype(hn::SetTableIndices(Floats(), static_cast<std::int32_t*>(nullptr)));
    Places point_[3];
    hn::Mask<Floats> isY_[3];
    hn::Mask<Floats> isZ_[3];
};

// Of up to sixteen fish: what takes a deformation in units of kPoseUnit / 1024 to the world, o and
// R times alpha.
struct Placements {
    HWY_ALIGN float rows[3][3][kWidestLanes];
    HWY_ALIGN float origin[3][kWidestLanes];
};

// The columns of states and traits from some fish on that decide its placement.
struct FrameColumns {
    const std::int32_t* origin[3];
    OrientationColumns orientation;
    const std::int32_t* lengthMillimetres;
};

// Sixteen fish, vector by vector.
HWY_INLINE void place(const FrameColumns& fish, Placements& placements) {
    const auto store = [&](Lanes value, float* column, std::size_t lane)
                           HWY_ATTR { hn::Store(value, kFloats, column + lane); };
    const Lanes two = hn::Set(kFloats, 2.0F);
    const Lanes metres = hn::Set(kFloats, kPositionUnitMetres);
    const Lanes unit = hn::Set(kFloats, 0.001F * kPoseUnit / 1024.0F);
    auto& rows = placements.rows;
    for (std::size_t lane = 0; lane < kWidestLanes; lane += hn::Lanes(kFloats)) {
        const auto integers = [lane](const std::int32_t* column) HWY_ATTR {
            return hn::ConvertTo(kFloats, hn::LoadU(kInts, column + lane));
        };
        for (std::size_t axis = 0; axis < 3; ++axis)
            store(hn::Mul(integers(fish.origin[axis]), metres), placements.origin[axis], lane);
        const QuaternionLanes q = orientationOf({fish.orientation.a + lane,
                                                 fish.orientation.b + lane,
                                                 fish.orientation.c + lane,
                                                 fish.orientation.largest + lane});
        const Lanes alpha = hn::Mul(integers(fish.lengthMillimetres), unit);
        const Lanes twice = hn::Mul(two, alpha);
        const auto straight = [&](Lanes a, Lanes b) HWY_ATTR {
            return hn::Sub(alpha, hn::Mul(twice, sumOfProducts(a, a, b, b)));
        };
        const auto sum = [&](Lanes a, Lanes b, Lanes c, Lanes d)
                             HWY_ATTR { return hn::Mul(twice, sumOfProducts(a, b, c, d)); };
        const auto difference = [&](Lanes a, Lanes b, Lanes c, Lanes d) HWY_ATTR {
            return hn::Mul(twice, differenceOfProducts(a, b, c, d));
        };
        store(straight(q.y, q.z), rows[0][0], lane);
        store(difference(q.x, q.y, q.w, q.z), rows[0][1], lane);
        store(sum(q.x, q.z, q.w, q.y), rows[0][2], lane);
        store(sum(q.x, q.y, q.w, q.z), rows[1][0], lane);
        store(straight(q.x, q.z), rows[1][1], lane);
        store(difference(q.y, q.z, q.w, q.x), rows[1][2], lane);
        store(difference(q.x, q.z, q.w, q.y), rows[2][0], lane);
        store(sum(q.y, q.z, q.w, q.x), rows[2][1], lane);
        store(straight(q.x, q.y), rows[2][2], lane);
    }
}

// Copies of the columns of fewer than sixteen fish, which vectors may read to the end.
struct FewFish {
    std::int32_t origin[3][kWidestLanes] = {};
    std::int32_t orientation[3][kWidestLanes] = {};
    std::uint8_t largest[kWidestLanes] = {};

    FewFish(const MotionStates& s, std::size_t first, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            origin[0][i] = s.x[first + i];
            origin[1][i] = s.y[first + i];
            origin[2][i] = s.z[first + i];
            orientation[0][i] = s.orientationA[first + i];
            orientation[1][i] = s.orientationB[first + i];
            orientation[2][i] = s.orientationC[first + i];
            largest[i] = s.orientationLargest[first + i];
        }
    }
};

void placeFish(const MotionStates& s,
               std::span<const FishTraits> traits,
               std::size_t first,
               std::size_t count,
               Placements& placements) {
    std::int32_t lengths[kWidestLanes] = {};
    for (std::size_t i = 0; i < count; ++i) lengths[i] = traits[first + i].lengthMillimetres;
    if (HWY_LIKELY(count == kWidestLanes)) {
        place({{s.x.data() + first, s.y.data() + first, s.z.data() + first},
               {s.orientationA.data() + first,
                s.orientationB.data() + first,
                s.orientationC.data() + first,
                s.orientationLargest.data() + first},
               lengths},
              placements);
        return;
    }
    const FewFish few(s, first, count);
    place({{few.origin[0], few.origin[1], few.origin[2]},
           {few.orientation[0], few.orientation[1], few.orientation[2], few.largest},
           lengths},
          placements);
}

// Two neighbouring samples of a cycle, and the weight of each: in 1/1024, pair by pair. A phase
// lies on a whole 1024th between two samples, so their sum is exact.
struct Sample {
    const PointPairs* pairs;
    IntLanes weights;
};

HWY_INLINE const PointPairs& pairsOf(const MotorTables& tables,
                                     std::uint16_t segment,
                                     std::uint16_t phase) {
    const auto action = static_cast<std::size_t>(tables.facts[segment] & kActionOfFacts);
    return tables.poses[action][phase >> kPhaseCellBits];
}

HWY_INLINE Sample sampleOf(const MotorTables& tables, std::uint16_t segment, std::uint16_t phase) {
    const std::int32_t second = phase & 1023;
    return {&pairsOf(tables, segment, phase), hn::Set(kInts, second << 16 | (1024 - second))};
}

// Fetches what a fish that comes so much later will read.
constexpr std::size_t kFetchAhead = 6;
HWY_INLINE void fetch(const PointPairs& pairs) {
    for (const auto& group : pairs.groups)
        for (const auto& axis : group) hwy::Prefetch(axis.data());
}

// Of each pair of 16-bit numbers in `pairs` the sum of both times those in `weights`.
HWY_INLINE IntLanes weighted(IntLanes pairs, IntLanes weights) {
#if HWY_TARGET == HWY_SCALAR  // a vector of this target holds half a pair
    const IntLanes low = hn::ShiftRight<16>(hn::ShiftLeft<16>(pairs));
    const IntLanes high = hn::ShiftRight<16>(pairs);
    return hn::Add(hn::Mul(low, hn::And(weights, hn::Set(kInts, 0xFFFF))),
                   hn::Mul(high, hn::ShiftRight<16>(weights)));
#else
    constexpr hn::Repartition<std::int16_t, Ints> kShorts;
    IntLanes rest = hn::Zero(kInts);
    const IntLanes sum = hn::ReorderWidenMulAccumulate(
        kInts, hn::BitCast(kShorts, pairs), hn::BitCast(kShorts, weights), hn::Zero(kInts), rest);
    return hn::RearrangeToOddPlusEven(sum, rest);
#endif
}

HWY_INLINE Lanes mixed(Lanes from, Lanes to, Lanes share) {
    return hn::Add(from, hn::Mul(share, hn::Sub(to, from)));
}

// One coordinate of a vector of points, the first of which is `point` of its group, in units of
// kPoseUnit / 1024.
HWY_INLINE Lanes between(const Sample& sample,
                         std::size_t group,
                         std::size_t axis,
                         std::size_t point) {
    const IntLanes pairs = hn::Load(kInts, &sample.pairs->groups[group][axis][point]);
    return hn::ConvertTo(kFloats, weighted(pairs, sample.weights));
}

// Writes all points of fish i of the placements, whose deformation is given by group, axis and
// point.
template <class Deformation>
HWY_INLINE void writeNodes(const Placements& placements,
                           std::size_t i,
                           const Interleave& interleave,
                           const Deformation& deformation,
                           body::NodalPoints& nodes) {
    Lanes rows[3][3];
    Lanes origin[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t of = 0; of < 3; ++of)
            rows[axis][of] = hn::Set(kFloats, placements.rows[axis][of][i]);
        origin[axis] = hn::Set(kFloats, placements.origin[axis][i]);
    }
    for (std::size_t group = 0; group < 2; ++group) {
        for (std::size_t point = 0; point < kPointGroup; point += hn::Lanes(kFloats)) {
            const Lanes x = deformation(group, 0, point);
            const Lanes y = deformation(group, 1, point);
            const Lanes z = deformation(group, 2, point);
            const auto coordinate = [&](std::size_t axis) HWY_ATTR {
                const Lanes* const row = rows[axis];
                return hn::Add(hn::Add(sumOfProducts(row[0], x, row[1], y), hn::Mul(row[2], z)),
                               origin[axis]);
            };
            interleave.store({coordinate(0), coordinate(1), coordinate(2)},
                             &nodes[group * kSecondGroup + point].x);
        }
    }
}

}  // namespace

void placeNodes(const MotorTables& tables,
                std::span<const FishTraits> traits,
                const MotionStates& s,
                std::size_t first,
                std::span<body::NodalPoints> nodes) {
    const Interleave interleave;
    Placements placements;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::size_t fish = first + i;
        const std::size_t place = i % kWidestLanes;
        if (place == 0)
            placeFish(s, traits, fish, std::min(nodes.size() - i, kWidestLanes), placements);
        if (i + kFetchAhead < nodes.size())
            fetch(pairsOf(tables, s.segment[fish + kFetchAhead], s.phase[fish + kFetchAhead]));
        const Sample to = sampleOf(tables, s.segment[fish], s.phase[fish]);
        if (HWY_LIKELY(s.warpFrame[fish] == s.warpLength[fish])) {
            writeNodes(
                placements,
                place,
                interleave,
                [&](std::size_t group, std::size_t axis, std::size_t point)
                    HWY_ATTR { return between(to, group, axis, point); },
                nodes[i]);
            continue;
        }
        const Sample from = sampleOf(tables, s.fromSegment[fish], s.fromPhase[fish]);
        const Lanes weight = hn::Set(
            kFloats,
            static_cast<float>(s.warpFrame[fish] + 1) / static_cast<float>(s.warpLength[fish] + 1));
        writeNodes(
            placements,
            place,
            interleave,
            [&](std::size_t group, std::size_t axis, std::size_t point) HWY_ATTR {
                return mixed(
                    between(from, group, axis, point), between(to, group, axis, point), weight);
            },
            nodes[i]);
    }
}

}  // namespace aquarama::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::motion {

HWY_EXPORT(placeNodes);

void nodalPoints(const MotorTables& tables,
                 std::span<const FishTraits> traits,
                 const MotionStates& states,
                 std::size_t first,
                 std::span<body::NodalPoints> nodes) {
    assert(first + nodes.size() <= states.size());
    assert(first + nodes.size() <= traits.size());
    HWY_DYNAMIC_DISPATCH(placeNodes)(tables, traits, states, first, nodes);
}

}  // namespace aquarama::motion
#endif
