// SPDX-License-Identifier: Apache-2.0
// meanHeadingReference() on vectors of fish, operation for operation.
#include <cassert>

#include "common/motion/headings.h"
#include "common/motion/motor_tables.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/headings_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/motion/motor_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::motion::HWY_NAMESPACE {
namespace {

constexpr hn::CappedTag<float, 4> kFour;

// bodyFromMean at a phase, between two samples of the segment: swayAt(). Writes four floats.
HWY_INLINE void storeSway(const SegmentTables& tables, std::uint32_t phase, float* four) {
    const Quaternion* const samples = &tables.bodyFromMean[phase >> kPhaseCellBits];
    const auto share = hn::Set(kFour, fractionOf(phase));
    for (std::size_t c = 0; c < 4; c += hn::Lanes(kFour)) {
        const auto from = hn::LoadU(kFour, &samples[0].w + c);
        const auto step = hn::Sub(hn::LoadU(kFour, &samples[1].w + c), from);
        hn::Store(hn::Add(from, hn::Mul(share, step)), kFour, four + c);
    }
}

// The same for a fish, which may be in a warp: swayOf(). Warps are rare and stay scalar.
HWY_INLINE void storeSwayOf(const MotorTables& tables,
                            const MotionStates& states,
                            std::size_t fish,
                            float* four) {
    if (HWY_UNLIKELY(states.warpFrame[fish] != states.warpLength[fish])) {
        const Quaternion sway = swayOf(tables, states, fish);
        const float parts[4] = {sway.w, sway.x, sway.y, sway.z};
        std::copy_n(parts, 4, four);
        return;
    }
    storeSway(tables.segments[states.segment[fish]], states.phase[fish], four);
}

}  // namespace

// last - first: a multiple of kWidestLanes. Group by group: gathers the sways of one vector of
// fish, then computes their headings side by side.
void headVectors(const MotorTables& tables,
                 const MotionStates& states,
                 std::size_t first,
                 std::size_t last,
                 const HeadingColumns& headings) {
    HWY_ALIGN float sways[4 * kWidestLanes];
    for (std::size_t fish = first; fish < last; fish += hn::Lanes(kFloats)) {
        for (std::size_t i = 0; i < hn::Lanes(kFloats); ++i)
            storeSwayOf(tables, states, fish + i, sways + 4 * slotOf(i));
        const QuaternionLanes turned = product(orientationOf(states, fish), load(sways));
        const Lanes squared = hn::Add(sumOfProducts(turned.w, turned.w, turned.x, turned.x),
                                      sumOfProducts(turned.y, turned.y, turned.z, turned.z));
        const Lanes inverse = hn::Div(hn::Set(kFloats, 1.0F), hn::Sqrt(squared));
        const VectorLanes forward = attitudeOf({hn::Mul(turned.w, inverse),
                                                hn::Mul(turned.x, inverse),
                                                hn::Mul(turned.y, inverse),
                                                hn::Mul(turned.z, inverse)})
                                        .forward;
        hn::StoreU(forward.x, kFloats, headings.x + (fish - first));
        hn::StoreU(forward.y, kFloats, headings.y + (fish - first));
        hn::StoreU(forward.z, kFloats, headings.z + (fish - first));
    }
}

}  // namespace aquarama::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::motion {

HWY_EXPORT(headVectors);

void meanHeadings(const MotorTables& tables,
                  const MotionStates& states,
                  std::size_t first,
                  std::size_t last,
                  const HeadingColumns& headings) {
    assert(first <= last);
    assert(last <= states.size());
    assert(first == last ||
           (headings.x != nullptr && headings.y != nullptr && headings.z != nullptr));
    const std::size_t rest = last - (last - first) % kWidestLanes;
    HWY_DYNAMIC_DISPATCH(headVectors)(tables, states, first, rest, headings);
    for (std::size_t fish = rest; fish < last; ++fish) {
        const glm::vec3 heading = meanHeadingReference(tables, states, fish);
        headings.x[fish - first] = heading.x;
        headings.y[fish - first] = heading.y;
        headings.z[fish - first] = heading.z;
    }
}

}  // namespace aquarama::motion
#endif
