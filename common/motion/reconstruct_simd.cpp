// SPDX-License-Identifier: Apache-2.0
// Eq. 12 and 13 for many fish. A pose is a weighted sum of two samples, or of four in a motion
// warp; it is turned, grown and placed in the same registers and written once.
#include "common/motion/phase_sample.h"
#include "common/motion/pose_tables.h"
#include "common/motion/reconstruct.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/reconstruct_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/body/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::motion::HWY_NAMESPACE {
namespace {

using namespace body::HWY_NAMESPACE;  // point_lanes-inl.h

HWY_INLINE Lanes load(const float* numbers) {
    return hn::Load(kFloats, numbers);
}

HWY_INLINE Lanes load(const std::int16_t* numbers) {
    const hn::Rebind<std::int16_t, Floats> shorts;
    return hn::ConvertTo(kFloats, hn::PromoteTo(kInts, hn::Load(shorts, numbers)));
}

// o + R alpha p, for p in units of kPoseUnit.
struct Placement {
    Lanes row[3][3];
    Lanes origin[3];
};

HWY_INLINE Placement placementOf(const PresentedFish& fish) {
    const auto& q = fish.rotation;
    const float a = fish.lengthMetres * kPoseUnit;
    const float rows[3][3] = {{a * (1.0F - 2.0F * (q.y * q.y + q.z * q.z)),
                               a * (2.0F * (q.x * q.y - q.w * q.z)),
                               a * (2.0F * (q.x * q.z + q.w * q.y))},
                              {a * (2.0F * (q.x * q.y + q.w * q.z)),
                               a * (1.0F - 2.0F * (q.x * q.x + q.z * q.z)),
                               a * (2.0F * (q.y * q.z - q.w * q.x))},
                              {a * (2.0F * (q.x * q.z - q.w * q.y)),
                               a * (2.0F * (q.y * q.z + q.w * q.x)),
                               a * (1.0F - 2.0F * (q.x * q.x + q.y * q.y))}};
    Placement placement{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) placement.row[i][j] = hn::Set(kFloats, rows[i][j]);
        placement.origin[i] = hn::Set(kFloats, fish.positionMetres[i]);
    }
    return placement;
}

// A stored pose and its share of what is shown.
template <class Pose>
struct Term {
    const Pose* pose;
    float weight;
};

template <class Table, std::size_t kTerms>
HWY_INLINE void reconstruct(const std::array<Term<typename Table::Pose>, kTerms>& terms,
                            const Placement& placement,
                            const Interleave& interleave,
                            float* placed) {
    Lanes weights[kTerms];
    for (std::size_t term = 0; term < kTerms; ++term)
        weights[term] = hn::Set(kFloats, terms[term].weight);
    const std::size_t lanes = hn::Lanes(kFloats);
    for (std::size_t group = 0; group < Table::kGroups; ++group) {
        for (std::size_t first = 0; first < body::kPointGroup; first += lanes) {
            Lanes p[3];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto lanesOf = [&](std::size_t term) HWY_ATTR {
                    return load(&(*terms[term].pose)[group].axes[axis][first]);
                };
                p[axis] = hn::Mul(weights[0], lanesOf(0));
                for (std::size_t term = 1; term < kTerms; ++term)
                    p[axis] = hn::MulAdd(weights[term], lanesOf(term), p[axis]);
            }
            const auto component = [&](int axis) HWY_ATTR {
                const auto& row = placement.row[axis];
                const Lanes far = hn::MulAdd(row[2], p[2], placement.origin[axis]);
                return hn::MulAdd(row[0], p[0], hn::MulAdd(row[1], p[1], far));
            };
            interleave.store(component(0),
                             component(1),
                             component(2),
                             placed + 3 * (Table::firstPointOf(group) + first));
        }
    }
}

template <class Table>
HWY_INLINE void reconstruct(const Table& table,
                            const PresentedFish& fish,
                            const Interleave& interleave,
                            float* placed) {
    using Pose = typename Table::Pose;
    const auto termsOf = [&](std::uint32_t segment, float phase, float share) HWY_ATTR {
        const PhaseSample sample = sampleAt(phase);
        const Pose* pose = table.at(segment, sample.before);
        return std::array<Term<Pose>, 2>{
            {{pose, share * (1.0F - sample.share)}, {pose + 1, share * sample.share}}};
    };
    const auto to = termsOf(fish.segment, fish.phase, fish.warpWeight);
    const Placement placement = placementOf(fish);
    if (fish.warpWeight < 1.0F) {
        const auto from = termsOf(fish.fromSegment, fish.fromPhase, 1.0F - fish.warpWeight);
        const std::array<Term<Pose>, 4> terms{to[0], to[1], from[0], from[1]};
        reconstruct<Table>(terms, placement, interleave, placed);
    } else {
        reconstruct<Table>(to, placement, interleave, placed);
    }
}

}  // namespace

void reconstructNodes(const ReconstructTables& tables,
                      std::span<const PresentedFish> fish,
                      body::NodalPoints* nodes) {
    const Interleave interleave;
    for (std::size_t i = 0; i < fish.size(); ++i)
        reconstruct(tables.nodes, fish[i], interleave, &nodes[i][0].x);
}

void reconstructControlPoints(const ReconstructTables& tables,
                              std::span<const PresentedFish> fish,
                              glm::vec3* points) {
    const Interleave interleave;
    for (std::size_t i = 0; i < fish.size(); ++i)
        reconstruct(tables.controlPoints, fish[i], interleave, &points[i * body::kControlPoints].x);
}

}  // namespace aquarama::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::motion {

HWY_EXPORT(reconstructNodes);
HWY_EXPORT(reconstructControlPoints);

void nodalPoints(const ReconstructTables& tables,
                 std::span<const PresentedFish> fish,
                 std::span<body::NodalPoints> nodes) {
    HWY_DYNAMIC_DISPATCH(reconstructNodes)(tables, fish, nodes.data());
}

void controlPoints(const ReconstructTables& tables,
                   std::span<const PresentedFish> fish,
                   std::span<glm::vec3> points) {
    HWY_DYNAMIC_DISPATCH(reconstructControlPoints)(tables, fish, points.data());
}

}  // namespace aquarama::motion
#endif
