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
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/motion/motor_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::motion::HWY_NAMESPACE {
namespace {

constexpr std::size_t kPoints = body::kNodalPoints;

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

// What takes a deformation in units of kPoseUnit to the world: o, and R times alpha.
struct Placement {
    Lanes row[3][3];
    Lanes origin[3];
};

HWY_INLINE Placement placementOf(const MotionStates& s,
                                 const FishTraits& traits,
                                 std::size_t fish) {
    const Quaternion q = unpack({{s.orientationA[fish], s.orientationB[fish], s.orientationC[fish]},
                                 s.orientationLargest[fish]});
    const float alpha = static_cast<float>(traits.lengthMillimetres) * (0.001F * kPoseUnit);
    const float twice = 2.0F * alpha;
    const float rows[3][3] = {{alpha - twice * (q.y * q.y + q.z * q.z),
                               twice * (q.x * q.y - q.w * q.z),
                               twice * (q.x * q.z + q.w * q.y)},
                              {twice * (q.x * q.y + q.w * q.z),
                               alpha - twice * (q.x * q.x + q.z * q.z),
                               twice * (q.y * q.z - q.w * q.x)},
                              {twice * (q.x * q.z - q.w * q.y),
                               twice * (q.y * q.z + q.w * q.x),
                               alpha - twice * (q.x * q.x + q.y * q.y)}};
    const float origin[3] = {static_cast<float>(s.x[fish]) * kPositionUnitMetres,
                             static_cast<float>(s.y[fish]) * kPositionUnitMetres,
                             static_cast<float>(s.z[fish]) * kPositionUnitMetres};
    Placement placement{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) placement.row[i][j] = hn::Set(kFloats, rows[i][j]);
        placement.origin[i] = hn::Set(kFloats, origin[i]);
    }
    return placement;
}

// Two neighbouring samples of a cycle, and where between them the phase lies.
struct Sample {
    const PoseColumns* pose;
    Lanes share;
};

HWY_INLINE Sample sampleOf(const MotorTables& tables, std::uint16_t segment, std::uint16_t phase) {
    return {
        &tables.poses[static_cast<std::size_t>(tables.action[segment])][phase >> kPhaseCellBits],
        hn::Set(kFloats, fractionOf(phase))};
}

HWY_INLINE Lanes mixed(Lanes from, Lanes to, Lanes share) {
    return hn::Add(from, hn::Mul(share, hn::Sub(to, from)));
}

// One coordinate of the points from `first` on.
HWY_INLINE Lanes between(const Sample& sample, std::size_t axis, std::size_t first) {
    return mixed(hn::LoadU(kFloats, &sample.pose[0][axis][first]),
                 hn::LoadU(kFloats, &sample.pose[1][axis][first]),
                 sample.share);
}

// Writes all points of a fish, whose deformation is given by coordinate and first point. The last
// vector of points ends at the last point and repeats some of those before.
template <class Deformation>
HWY_INLINE void placeAll(const Placement& placement,
                         const Interleave& interleave,
                         const Deformation& deformation,
                         body::NodalPoints& nodes) {
    const std::size_t lanes = hn::Lanes(kFloats);
    for (std::size_t at = 0; at < kPoints; at += lanes) {
        const std::size_t first = std::min(at, kPoints - lanes);
        const Lanes x = deformation(0, first);
        const Lanes y = deformation(1, first);
        const Lanes z = deformation(2, first);
        const auto coordinate = [&](std::size_t axis) HWY_ATTR {
            const Lanes* const row = placement.row[axis];
            return hn::Add(hn::Add(sumOfProducts(row[0], x, row[1], y), hn::Mul(row[2], z)),
                           placement.origin[axis]);
        };
        interleave.store({coordinate(0), coordinate(1), coordinate(2)}, &nodes[first].x);
    }
}

}  // namespace

void placeNodes(const MotorTables& tables,
                std::span<const FishTraits> traits,
                const MotionStates& s,
                std::size_t first,
                std::span<body::NodalPoints> nodes) {
    const Interleave interleave;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::size_t fish = first + i;
        const Placement placement = placementOf(s, traits[fish], fish);
        const Sample to = sampleOf(tables, s.segment[fish], s.phase[fish]);
        if (HWY_LIKELY(s.warpFrame[fish] == s.warpLength[fish])) {
            placeAll(
                placement,
                interleave,
                [&](std::size_t axis, std::size_t point)
                    HWY_ATTR { return between(to, axis, point); },
                nodes[i]);
            continue;
        }
        const Sample from = sampleOf(tables, s.fromSegment[fish], s.fromPhase[fish]);
        const Lanes weight = hn::Set(
            kFloats,
            static_cast<float>(s.warpFrame[fish] + 1) / static_cast<float>(s.warpLength[fish] + 1));
        placeAll(
            placement,
            interleave,
            [&](std::size_t axis, std::size_t point) HWY_ATTR {
                return mixed(between(from, axis, point), between(to, axis, point), weight);
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
