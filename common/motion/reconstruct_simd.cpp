// SPDX-License-Identifier: Apache-2.0
// Eq. 12 and 13 for many fish: a pose is a weighted sum of two samples, or of four in a motion
// warp, taken over its numbers as they lie; then each point is turned and placed.
#include "common/motion/phase_sample.h"
#include "common/motion/reconstruct.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/reconstruct_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aquarama::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;  // no more lanes than a fish has nodal points
using Lanes = hn::Vec<Floats>;
constexpr Floats kFloats;

// A stored pose and its share of what is shown, in metres a unit.
struct Term {
    const std::int16_t* pose;
    float weight;
};

HWY_INLINE Lanes weighted(const Term& term, std::size_t at) {
    const hn::Rebind<std::int16_t, Floats> shorts;
    const hn::RebindToSigned<Floats> ints;
    const auto stored = hn::PromoteTo(ints, hn::LoadU(shorts, term.pose + at));
    return hn::Mul(hn::ConvertTo(kFloats, stored), hn::Set(kFloats, term.weight));
}

// sums[i] = sum over terms of weight * pose[i]. The last vector overlaps the one before it: nothing
// is read or written beyond the pose.
template <std::size_t kNumbers, std::size_t kTerms>
HWY_INLINE void sumPoses(const std::array<Term, kTerms>& terms, float* sums) {
    const std::size_t lanes = hn::Lanes(kFloats);
    for (std::size_t i = 0; i < kNumbers; i += lanes) {
        const std::size_t at = std::min(i, kNumbers - lanes);
        Lanes sum = weighted(terms[0], at);
        for (std::size_t term = 1; term < kTerms; ++term) {
            sum = hn::Add(sum, weighted(terms[term], at));
        }
        hn::StoreU(sum, kFloats, sums + at);
    }
}

struct Placement {
    Lanes row[3][3];
    Lanes origin[3];
};

HWY_INLINE Placement placementOf(const PresentedFish& fish) {
    const auto& q = fish.rotation;
    const float rows[3][3] = {{1.0F - 2.0F * (q.y * q.y + q.z * q.z),
                               2.0F * (q.x * q.y - q.w * q.z),
                               2.0F * (q.x * q.z + q.w * q.y)},
                              {2.0F * (q.x * q.y + q.w * q.z),
                               1.0F - 2.0F * (q.x * q.x + q.z * q.z),
                               2.0F * (q.y * q.z - q.w * q.x)},
                              {2.0F * (q.x * q.z - q.w * q.y),
                               2.0F * (q.y * q.z + q.w * q.x),
                               1.0F - 2.0F * (q.x * q.x + q.y * q.y)}};
    Placement placement{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) placement.row[i][j] = hn::Set(kFloats, rows[i][j]);
        placement.origin[i] = hn::Set(kFloats, fish.positionMetres[i]);
    }
    return placement;
}

template <std::size_t kPoints>
HWY_INLINE void place(const Placement& placement, const float* posed, float* placed) {
    const std::size_t lanes = hn::Lanes(kFloats);
    for (std::size_t i = 0; i < kPoints; i += lanes) {
        const std::size_t at = 3 * std::min(i, kPoints - lanes);
        Lanes x{};
        Lanes y{};
        Lanes z{};
        hn::LoadInterleaved3(kFloats, posed + at, x, y, z);
        const auto component = [&](int axis) HWY_ATTR {
            const auto& row = placement.row[axis];
            return hn::MulAdd(
                row[0], x, hn::MulAdd(row[1], y, hn::MulAdd(row[2], z, placement.origin[axis])));
        };
        hn::StoreInterleaved3(component(0), component(1), component(2), kFloats, placed + at);
    }
}

// posesOf(segment)[phase] is an array of points of three 16-bit numbers.
template <std::size_t kPoints, class PosesOf>
HWY_INLINE void reconstruct(const Repertoire& repertoire,
                            const PresentedFish& fish,
                            const PosesOf& posesOf,
                            float* placed) {
    const auto termsOf = [&](std::uint32_t segment, float phase, float share) HWY_ATTR {
        const auto& poses = posesOf(segmentOf(repertoire, segment));
        const PhaseSample sample = sampleAt(phase);
        const float metresAUnit = share * fish.lengthMetres * kPoseUnit;
        return std::array<Term, 2>{
            {{poses[sample.before][0].data(), metresAUnit * (1.0F - sample.share)},
             {poses[sample.after][0].data(), metresAUnit * sample.share}}};
    };
    HWY_ALIGN float posed[3 * kPoints];
    const auto to = termsOf(fish.segment, fish.phase, fish.warpWeight);
    if (fish.warpWeight < 1.0F) {
        const auto from = termsOf(fish.fromSegment, fish.fromPhase, 1.0F - fish.warpWeight);
        const std::array<Term, 4> terms{to[0], to[1], from[0], from[1]};
        sumPoses<3 * kPoints>(terms, posed);
    } else {
        sumPoses<3 * kPoints>(to, posed);
    }
    place<kPoints>(placementOf(fish), posed, placed);
}

}  // namespace

void reconstructNodes(const Repertoire& repertoire,
                      std::span<const PresentedFish> fish,
                      NodalPoints* nodes) {
    const auto nodesOf = [](const ActionSegment& segment) HWY_ATTR -> const auto& {
        return segment.nodes;
    };
    for (std::size_t i = 0; i < fish.size(); ++i) {
        reconstruct<kNodalPoints>(repertoire, fish[i], nodesOf, &nodes[i][0].x);
    }
}

void reconstructControlPoints(const Repertoire& repertoire,
                              std::span<const PresentedFish> fish,
                              glm::vec3* points) {
    const auto controlPointsOf = [](const ActionSegment& segment) HWY_ATTR -> const auto& {
        return segment.controlPoints;
    };
    for (std::size_t i = 0; i < fish.size(); ++i) {
        reconstruct<kControlPoints>(
            repertoire, fish[i], controlPointsOf, &points[i * kControlPoints].x);
    }
}

}  // namespace aquarama::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama {

HWY_EXPORT(reconstructNodes);
HWY_EXPORT(reconstructControlPoints);

void nodalPoints(const Repertoire& repertoire,
                 std::span<const PresentedFish> fish,
                 std::span<NodalPoints> nodes) {
    HWY_DYNAMIC_DISPATCH(reconstructNodes)(repertoire, fish, nodes.data());
}

void controlPoints(const Repertoire& repertoire,
                   std::span<const PresentedFish> fish,
                   std::span<glm::vec3> points) {
    HWY_DYNAMIC_DISPATCH(reconstructControlPoints)(repertoire, fish, points.data());
}

}  // namespace aquarama
#endif
