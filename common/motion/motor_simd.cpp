// SPDX-License-Identifier: Apache-2.0
// The vectorised step: what motor.cpp does to a fish, on as many as the processor has lanes.
#include <algorithm>
#include <bit>
#include <cstring>

#include "common/motion/motor.h"
#include "common/motion/motor_tick.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/motor_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/motion/motor_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::HWY_NAMESPACE {
namespace {

// As many as a 64-bit set holds; enough that one vector's arithmetic hides the latency of
// another's.
constexpr std::size_t kBlockFish = 64;
using FishSet = std::uint64_t;  // bit i: fish i of the block

// What a block of fish does in this tick: phases and fractions of their cells, phase rates, and the
// travels, four floats a fish, to be read as columns.
struct Block {
    HWY_ALIGN std::int32_t from[kBlockFish];
    HWY_ALIGN std::int32_t to[kBlockFish];
    HWY_ALIGN float atStart[kBlockFish];
    HWY_ALIGN float atEnd[kBlockFish];
    HWY_ALIGN std::int32_t rate[kBlockFish];
    HWY_ALIGN float start[4 * kBlockFish];
    HWY_ALIGN float end[4 * kBlockFish];
    HWY_ALIGN float bodyFromMean[4 * kBlockFish];
    HWY_ALIGN float left[4 * kBlockFish];  // translation and speed at the start
    HWY_ALIGN float reached[4 * kBlockFish];
    HWY_ALIGN std::int32_t lengthMillimetres[kBlockFish];
};

void store(const Travel& travel, Block& block, std::size_t i) {
    const auto put = [i](const auto& four, float* column) {
        static_assert(sizeof(four) == 4 * sizeof(float));
        std::memcpy(column + 4 * i, &four, sizeof(four));
    };
    put(travel.start.rotation, block.start);
    put(travel.end.rotation, block.end);
    put(travel.bodyFromMean, block.bodyFromMean);
    put(travel.start.translationAndSpeed, block.left);
    put(travel.end.translationAndSpeed, block.reached);
    block.rate[i] = travel.rate;
}

template <class Tag>
HWY_INLINE FishSet setOf(Tag tag, hn::Mask<Tag> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    return bits[0] | FishSet{bits[1]} << 8U;
}

// Every fish of the block plays on at its commanded rate. Returns those that perhaps should not
// have: they are in a motion warp, or another segment is wanted, or they came to an end of theirs,
// or go backwards.
HWY_INLINE FishSet playOn(const MotorColumns& columns,
                          std::size_t first,
                          std::size_t count,
                          Block& block) {
    const hn::Rebind<std::uint16_t, Ints> shorts;
    const hn::Rebind<std::int16_t, Ints> rates;
    const hn::Rebind<std::uint8_t, Ints> bytes;
    FishSet restless = 0;
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kInts)) {
        const std::size_t fish = first + lane;
        const auto phase = hn::LoadU(shorts, columns.phase + fish);
        const auto rate = hn::LoadU(rates, columns.phaseRate + fish);
        const IntLanes from = hn::PromoteTo(kInts, phase);
        const IntLanes step = hn::PromoteTo(kInts, rate);
        const IntLanes to = hn::Add(from, step);
        hn::Store(from, kInts, block.from + lane);
        hn::Store(to, kInts, block.to + lane);
        hn::Store(step, kInts, block.rate + lane);
        hn::StoreU(hn::Add(phase, hn::BitCast(shorts, rate)), shorts, columns.phase + fish);
        const auto warps = hn::Ne(hn::LoadU(bytes, columns.warpFrame + fish),
                                  hn::LoadU(bytes, columns.warpLength + fish));
        const auto leaves = hn::Ne(hn::LoadU(bytes, columns.wanted + fish),
                                   hn::LoadU(bytes, columns.segment + fish));
        // Past an end of the cycle there are bits above the 16 of a phase.
        const auto passes =
            hn::Or(hn::Lt(step, hn::Zero(kInts)), hn::Gt(to, hn::Set(kInts, 0xFFFF)));
        restless |= (setOf(bytes, hn::Or(warps, leaves)) | setOf(kInts, passes)) << lane;
    }
    return restless;
}

// Takes the restless fish back, to do what they should. Returns those of them that warp.
HWY_INLINE FishSet settle(const MotorStep& step,
                          const MotorColumns& columns,
                          std::size_t first,
                          FishSet restless,
                          Block& block) {
    FishSet warping = 0;
    for (; restless != 0; restless &= restless - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(restless));
        columns.phase[first + i] = static_cast<std::uint16_t>(block.from[i]);
        const Playing playing = advanceSegment(*step.tables, columns, first + i);
        block.to[i] = playing.to;
        block.from[i] = playing.from;
        block.rate[i] = playing.to - playing.from;
        warping |= FishSet{playing.warps} << i;
    }
    return warping;
}

HWY_INLINE void fractionsOf(const std::int32_t* phases, std::size_t count, float* fractions) {
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kInts)) {
        const IntLanes inCell = hn::And(hn::Load(kInts, phases + lane), hn::Set(kInts, 1023));
        hn::Store(hn::Mul(hn::ConvertTo(kFloats, inCell), hn::Set(kFloats, kPhaseCellUnit)),
                  kFloats,
                  fractions + lane);
    }
}

// The four components of a sample, in as many vectors as the instruction set needs.
using Components = hn::CappedTag<float, 4>;
constexpr Components kComponents;

// Components of two neighbouring samples, interpolated.
HWY_INLINE hn::Vec<Components> between(const float* a, const float* b, float share) {
    const auto from = hn::LoadU(kComponents, a);
    const auto step = hn::Sub(hn::LoadU(kComponents, b), from);
    return hn::Add(from, hn::Mul(hn::Set(kComponents, share), step));
}

HWY_INLINE void storePlayed(const SegmentTables& tables, Block& block, std::size_t i) {
    const auto end = static_cast<std::size_t>(block.to[i]) >> kPhaseCellBits;
    const PathSample* a = &tables.path[static_cast<std::size_t>(block.from[i]) >> kPhaseCellBits];
    const PathSample* b = &tables.path[end];
    const Quaternion* m = &tables.bodyFromMean[end % kPhases];
    const float atStart = block.atStart[i];
    const float atEnd = block.atEnd[i];
    for (std::size_t c = 0; c < 4; c += hn::Lanes(kComponents)) {
        const std::size_t to = 4 * i + c;
        const auto left =
            between(&a->translationAndSpeed[c], &a[1].translationAndSpeed[c], atStart);
        const auto reached =
            between(&b->translationAndSpeed[c], &b[1].translationAndSpeed[c], atEnd);
        const auto start = between(&a->rotation.w + c, &a[1].rotation.w + c, atStart);
        const auto ended = between(&b->rotation.w + c, &b[1].rotation.w + c, atEnd);
        hn::Store(left, kComponents, block.left + to);
        hn::Store(reached, kComponents, block.reached + to);
        hn::Store(start, kComponents, block.start + to);
        hn::Store(ended, kComponents, block.end + to);
        hn::Store(between(&m->w + c, &m[1].w + c, atEnd), kComponents, block.bodyFromMean + to);
    }
}

// The warping fish play too, which costs less than asking each, and are then put right.
HWY_INLINE void travelBlock(const MotorStep& step,
                            const MotorColumns& columns,
                            std::size_t first,
                            std::size_t count,
                            Block& block) {
    const FishSet restless = playOn(columns, first, count, block);
    FishSet warping = settle(step, columns, first, restless, block);
    fractionsOf(block.from, count, block.atStart);
    fractionsOf(block.to, count, block.atEnd);
    for (std::size_t i = 0; i < count; ++i) {
        storePlayed(step.tables->segments[columns.segment[first + i]], block, i);
        block.lengthMillimetres[i] = step.traits[first + i].lengthMillimetres;
    }
    for (; warping != 0; warping &= warping - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(warping));
        store(warpingTravel(*step.tables, columns, first + i), block, i);
    }
}

// The lanes of `block` from `lane` on are the fish from `fish` on.
HWY_INLINE void stepLanes(const MotorStep& step,
                          const Block& block,
                          std::size_t lane,
                          std::size_t fish) {
    MotionStates& s = *step.states;
    const QuaternionLanes start = load(block.start + 4 * lane);
    const QuaternionLanes end = load(block.end + 4 * lane);
    const QuaternionLanes bodyFromMean = load(block.bodyFromMean + 4 * lane);
    const PlaceLanes a = loadPlace(block.left + 4 * lane);
    const PlaceLanes b = loadPlace(block.reached + 4 * lane);
    const Lanes rate = hn::ConvertTo(kFloats, hn::Load(kInts, block.rate + lane));
    const Lanes pathAtEnd = pathSpeed(b.speed, rate);
    const Lanes speed = speedAfter(
        step.tables->loss,
        hn::ConvertTo(kFloats, hn::LoadU(kInts, s.speed.data() + fish)),
        pathSpeed(a.speed, rate),
        pathAtEnd,
        hn::RebindMask(
            kFloats,
            hn::Eq(bytesAt(s.segment, fish), hn::Set(kInts, static_cast<int>(Action::Glide)))),
        hn::Mul(hn::ConvertTo(kFloats, bytesAt(step.commands->brake, fish)),
                hn::Set(kFloats, kBrakeUnit)));
    hn::StoreU(hn::ConvertTo(kInts, speed), kInts, s.speed.data() + fish);
    const QuaternionLanes seenFrom = renormalisedLanes(quotient(orientationOf(s, fish), start));
    const QuaternionLanes swum = product(seenFrom, end);
    const AttitudeLanes attitude = attitudeOf(product(swum, bodyFromMean));
    const VectorLanes moves = rotated(seenFrom,
                                      {hn::Sub(b.translation.x, a.translation.x),
                                       hn::Sub(b.translation.y, a.translation.y),
                                       hn::Sub(b.translation.z, a.translation.z)});
    const Lanes faster = hn::Mul(hn::Sub(speed, pathAtEnd), hn::Set(kFloats, kLengthsPerSpeedUnit));
    const Lanes units =
        hn::Mul(hn::ConvertTo(kFloats, hn::Load(kInts, block.lengthMillimetres + lane)),
                hn::Set(kFloats, kUnitsPerMillimetre));
    move(s.x, fish, hn::Mul(hn::Add(moves.x, hn::Mul(faster, attitude.forward.x)), units));
    move(s.y, fish, hn::Mul(hn::Add(moves.y, hn::Mul(faster, attitude.forward.y)), units));
    move(s.z, fish, hn::Mul(hn::Add(moves.z, hn::Mul(faster, attitude.forward.z)), units));
    const VectorLanes steering = halfSteering(attitude,
                                              commanded(step.commands->pitch, fish, kPitchUnit),
                                              commanded(step.commands->yawRate, fish, kYawUnit));
    const QuaternionLanes turn{hn::Set(kFloats, 1.0F), steering.x, steering.y, steering.z};
    setOrientation(renormalisedLanes(product(turn, swum)), s, fish);
}

}  // namespace

// A multiple of kWidestLanes fish.
void stepVectors(const MotorStep& step) {
    const MotorColumns columns = columnsOf(*step.commands, *step.states);
    Block block;
    for (std::size_t fish = step.first; fish < step.last; fish += kBlockFish) {
        const std::size_t count = std::min(kBlockFish, step.last - fish);
        travelBlock(step, columns, fish, count, block);
        for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kFloats)) {
            stepLanes(step, block, lane, fish + lane);
        }
    }
}

}  // namespace aquarama::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama {

HWY_EXPORT(stepVectors);

void MotorStep::run() const {
    MotorStep vectors = *this;
    vectors.last = last - (last - first) % kWidestLanes;
    HWY_DYNAMIC_DISPATCH(stepVectors)(vectors);
    MotorStep rest = *this;
    rest.first = vectors.last;
    rest.runReference();
}

}  // namespace aquarama
#endif
