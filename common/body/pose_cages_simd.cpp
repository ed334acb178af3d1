// SPDX-License-Identifier: Apache-2.0
// The vectorised poseCage(): sixteen vertices at a time, each a weighted sum of all seven knots.
// That most weights are zero costs less than to look up the few that are not.
#include "common/body/cage_tables.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/body/pose_cages_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/body/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::body::HWY_NAMESPACE {
namespace {

struct Vector {
    Lanes x, y, z;
};

using Knots = std::array<glm::vec3, kKnots>;
using Shares = std::array<CageTables::Numbers, kKnots>;

HWY_INLINE Vector weighted(const Knots& knots, const Shares& shares, std::size_t first) {
    Vector sum{hn::Zero(kFloats), hn::Zero(kFloats), hn::Zero(kFloats)};
    for (std::size_t k = 0; k < kKnots; ++k) {
        const Lanes share = hn::Load(kFloats, &shares[k][first]);
        sum.x = hn::MulAdd(share, hn::Set(kFloats, knots[k].x), sum.x);
        sum.y = hn::MulAdd(share, hn::Set(kFloats, knots[k].y), sum.y);
        sum.z = hn::MulAdd(share, hn::Set(kFloats, knots[k].z), sum.z);
    }
    return sum;
}

HWY_INLINE Lanes dot(const Vector& a, const Vector& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

// One Newton step makes the processor's 12 or 14 bits all that a float has.
HWY_INLINE Lanes inverseRoot(Lanes square) {
    const Lanes guess = hn::ApproximateReciprocalSqrt(square);
    const Lanes half = hn::Mul(hn::Set(kFloats, 0.5F), hn::Mul(square, guess));
    return hn::Mul(guess, hn::NegMulAdd(half, guess, hn::Set(kFloats, 1.5F)));
}

HWY_INLINE Vector scaled(const Vector& v, Lanes factor) {
    return {hn::Mul(v.x, factor), hn::Mul(v.y, factor), hn::Mul(v.z, factor)};
}

HWY_INLINE Vector added(const Vector& v, Lanes factor, const Vector& to) {
    return {hn::MulAdd(v.x, factor, to.x),
            hn::MulAdd(v.y, factor, to.y),
            hn::MulAdd(v.z, factor, to.z)};
}

HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)),
            hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

// As place() in pose_cage.cpp, for lanes of vertices.
HWY_INLINE Vector place(const Spine& spine,
                        const CageTables::Group& group,
                        std::size_t first,
                        Lanes length) {
    const Vector tailwards = weighted(spine.centres, group.tailwards, first);
    const Vector back = scaled(tailwards, inverseRoot(dot(tailwards, tailwards)));
    const Vector side = weighted(spine.right, group.right, first);
    const Vector across = added(back, hn::Neg(dot(side, back)), side);
    const Vector right = scaled(across, inverseRoot(dot(across, across)));
    const Vector up = cross(back, right);
    const Vector centre = weighted(spine.centres, group.centre, first);
    const Lanes y = hn::Mul(length, hn::Load(kFloats, &group.y[first]));
    const Lanes z = hn::Mul(length, hn::Load(kFloats, &group.z[first]));
    return added(right, z, added(up, y, centre));
}

}  // namespace

void poseCagesOf(const CageTables& tables,
                 std::span<const NodalPoints> nodes,
                 const float* lengths,
                 glm::vec3* controlPoints) {
    const Interleave interleave;
    for (std::size_t fish = 0; fish < nodes.size(); ++fish) {
        const Spine spine = spineOf(tables.stations, nodes[fish]);
        const Lanes length = hn::Set(kFloats, lengths[fish]);
        glm::vec3* const points = controlPoints + fish * kControlPoints;
        for (std::size_t g = 0; g < tables.groups.size(); ++g) {
            for (std::size_t first = 0; first < kPointGroup; first += hn::Lanes(kFloats)) {
                const Vector placed = place(spine, tables.groups[g], first, length);
                interleave.store(placed.x,
                                 placed.y,
                                 placed.z,
                                 &points[firstPointOf(g, kControlPoints) + first].x);
            }
        }
    }
}

}  // namespace aquarama::body::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::body {

HWY_EXPORT(poseCagesOf);

void poseCages(const CageTables& tables,
               std::span<const NodalPoints> nodes,
               std::span<const float> lengths,
               std::span<glm::vec3> controlPoints) {
    HWY_DYNAMIC_DISPATCH(poseCagesOf)(tables, nodes, lengths.data(), controlPoints.data());
}

}  // namespace aquarama::body
#endif
