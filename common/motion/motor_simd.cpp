// SPDX-License-Identifier: Apache-2.0
// The vectorised step: the arithmetic of motor.cpp, operation for operation, on as many fish as the
// processor has lanes. Elementwise only, and no fused multiply-add: so every width gives its bits.
#include <algorithm>

#include "common/motion/motor.h"
#include "common/motion/motor_tick.h"

#ifndef AQUARAMA_MOTOR_WIDEST_LANES
#define AQUARAMA_MOTOR_WIDEST_LANES
namespace aquarama {
// A range is stepped in whole vectors of this many fish on every machine, and what is left plainly.
inline constexpr std::size_t kWidestLanes = 16;
}  // namespace aquarama
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/motor_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aquarama::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Large enough that one vector's arithmetic hides the latency of another's.
constexpr std::size_t kBlockFish = 64;

using Floats = hn::CappedTag<float, kWidestLanes>;
using Ints = hn::RebindToSigned<Floats>;
using Lanes = hn::Vec<Floats>;
using IntLanes = hn::Vec<Ints>;
constexpr Floats kFloats;
constexpr Ints kInts;

struct QuaternionLanes {
    Lanes w, x, y, z;
};
struct VectorLanes {
    Lanes x, y, z;
};

// The travels of a block, four floats a fish, to be read as columns.
struct Block {
    HWY_ALIGN float start[4 * kBlockFish];
    HWY_ALIGN float end[4 * kBlockFish];
    HWY_ALIGN float bodyFromMean[4 * kBlockFish];
    HWY_ALIGN float translation[4 * kBlockFish];
    HWY_ALIGN std::int32_t lengthMillimetres[kBlockFish];
};

void store(const Travel& travel, Block& block, std::size_t i) {
    const auto put = [i](const Quaternion& q, float* column) {
        column[4 * i] = q.w;
        column[4 * i + 1] = q.x;
        column[4 * i + 2] = q.y;
        column[4 * i + 3] = q.z;
    };
    put(travel.start, block.start);
    put(travel.end, block.end);
    put(travel.bodyFromMean, block.bodyFromMean);
    const auto& [x, y, z] = travel.translation;
    put({x, y, z, 0.0F}, block.translation);
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

HWY_INLINE void storePlayed(const SegmentTables& tables,
                            const Playing& playing,
                            Block& block,
                            std::size_t i) {
    const std::size_t end = playing.to >> kPhaseCellBits;
    const PathSample* a = &tables.path[playing.from >> kPhaseCellBits];
    const PathSample* b = &tables.path[end];
    const Quaternion* m = &tables.bodyFromMean[end % kPhases];
    const float atStart = fractionOf(playing.from);
    const float atEnd = fractionOf(playing.to);
    for (std::size_t c = 0; c < 4; c += hn::Lanes(kComponents)) {
        const std::size_t to = 4 * i + c;
        const auto left = between(&a->translation[c], &a[1].translation[c], atStart);
        const auto reached = between(&b->translation[c], &b[1].translation[c], atEnd);
        const auto start = between(&a->rotation.w + c, &a[1].rotation.w + c, atStart);
        const auto ended = between(&b->rotation.w + c, &b[1].rotation.w + c, atEnd);
        hn::Store(hn::Sub(reached, left), kComponents, block.translation + to);
        hn::Store(start, kComponents, block.start + to);
        hn::Store(ended, kComponents, block.end + to);
        hn::Store(between(&m->w + c, &m[1].w + c, atEnd), kComponents, block.bodyFromMean + to);
    }
}

HWY_INLINE void travelBlock(const MotorStep& step,
                            const MotorColumns& columns,
                            std::size_t first,
                            std::size_t count,
                            Block& block) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t fish = first + i;
        const Playing playing = advanceSegment(*step.tables, columns, fish);
        if (playing.glides) {
            store(glidingTravel(*step.tables, columns, fish), block, i);
        } else {
            storePlayed(step.tables->segments[columns.segment[fish]], playing, block, i);
        }
        block.lengthMillimetres[i] = step.traits[fish].lengthMillimetres;
    }
}

HWY_INLINE Lanes sumOfProducts(Lanes a, Lanes b, Lanes c, Lanes d) {
    return hn::Add(hn::Mul(a, b), hn::Mul(c, d));
}
HWY_INLINE Lanes differenceOfProducts(Lanes a, Lanes b, Lanes c, Lanes d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
HWY_INLINE Lanes bounded(Lanes value, float limit) {
    return hn::Min(hn::Max(value, hn::Set(kFloats, -limit)), hn::Set(kFloats, limit));
}

// To the nearest even integer, for |value| up to 2^22: where the sum's last bit is worth one.
HWY_INLINE IntLanes rounded(Lanes value) {
    const Lanes shift = hn::Set(kFloats, 12582912.0F);  // 1.5 * 2^23
    return hn::Sub(hn::BitCast(kInts, hn::Add(value, shift)), hn::BitCast(kInts, shift));
}

HWY_INLINE QuaternionLanes load(const float* quaternions) {
    QuaternionLanes q{};
    hn::LoadInterleaved4(kFloats, quaternions, q.w, q.x, q.y, q.z);
    return q;
}

HWY_INLINE QuaternionLanes product(const QuaternionLanes& a, const QuaternionLanes& b) {
    return {hn::Sub(differenceOfProducts(a.w, b.w, a.x, b.x), sumOfProducts(a.y, b.y, a.z, b.z)),
            hn::Add(sumOfProducts(a.w, b.x, a.x, b.w), differenceOfProducts(a.y, b.z, a.z, b.y)),
            hn::Add(sumOfProducts(a.w, b.y, a.y, b.w), differenceOfProducts(a.z, b.x, a.x, b.z)),
            hn::Add(sumOfProducts(a.w, b.z, a.z, b.w), differenceOfProducts(a.x, b.y, a.y, b.x))};
}

// a times the conjugate of b: the signs are carried into the sums, which leaves every bit alone.
HWY_INLINE QuaternionLanes quotient(const QuaternionLanes& a, const QuaternionLanes& b) {
    return {
        hn::Add(sumOfProducts(a.w, b.w, a.x, b.x), sumOfProducts(a.y, b.y, a.z, b.z)),
        hn::Sub(differenceOfProducts(a.x, b.w, a.w, b.x), differenceOfProducts(a.y, b.z, a.z, b.y)),
        hn::Sub(differenceOfProducts(a.y, b.w, a.w, b.y), differenceOfProducts(a.z, b.x, a.x, b.z)),
        hn::Sub(differenceOfProducts(a.z, b.w, a.w, b.z),
                differenceOfProducts(a.x, b.y, a.y, b.x))};
}

HWY_INLINE QuaternionLanes renormalisedLanes(const QuaternionLanes& q) {
    const Lanes squared =
        hn::Add(sumOfProducts(q.w, q.w, q.x, q.x), sumOfProducts(q.y, q.y, q.z, q.z));
    const Lanes inverse = hn::Sub(hn::Set(kFloats, 1.5F), hn::Mul(hn::Set(kFloats, 0.5F), squared));
    return {
        hn::Mul(q.w, inverse), hn::Mul(q.x, inverse), hn::Mul(q.y, inverse), hn::Mul(q.z, inverse)};
}

HWY_INLINE VectorLanes rotated(const QuaternionLanes& q, const VectorLanes& v) {
    const Lanes two = hn::Set(kFloats, 2.0F);
    const Lanes x = hn::Mul(two, differenceOfProducts(q.y, v.z, q.z, v.y));
    const Lanes y = hn::Mul(two, differenceOfProducts(q.z, v.x, q.x, v.z));
    const Lanes z = hn::Mul(two, differenceOfProducts(q.x, v.y, q.y, v.x));
    return {hn::Add(hn::Add(v.x, hn::Mul(q.w, x)), differenceOfProducts(q.y, z, q.z, y)),
            hn::Add(hn::Add(v.y, hn::Mul(q.w, y)), differenceOfProducts(q.z, x, q.x, z)),
            hn::Add(hn::Add(v.z, hn::Mul(q.w, z)), differenceOfProducts(q.x, y, q.y, x))};
}

HWY_INLINE auto isLargest(IntLanes largest, int component) {
    return hn::RebindMask(kFloats, hn::Eq(largest, hn::Set(kInts, component)));
}

HWY_INLINE QuaternionLanes orientationOf(const MotionStates& s, std::size_t fish) {
    const auto component = [fish](const std::vector<std::int32_t>& column) HWY_ATTR {
        return hn::Mul(hn::ConvertTo(kFloats, hn::LoadU(kInts, column.data() + fish)),
                       hn::Set(kFloats, kOrientationUnit));
    };
    const hn::Rebind<std::uint8_t, Ints> bytes;
    const IntLanes largest =
        hn::PromoteTo(kInts, hn::LoadU(bytes, s.orientationLargest.data() + fish));
    const Lanes a = component(s.orientationA);
    const Lanes b = component(s.orientationB);
    const Lanes c = component(s.orientationC);
    const Lanes squared =
        hn::Sub(hn::Set(kFloats, 1.0F), hn::Add(sumOfProducts(a, a, b, b), hn::Mul(c, c)));
    const Lanes most = hn::Sqrt(hn::Max(squared, hn::Zero(kFloats)));
    const auto isW = isLargest(largest, 0);
    const auto isX = isLargest(largest, 1);
    const auto isY = isLargest(largest, 2);
    const auto isZ = isLargest(largest, 3);
    return {hn::IfThenElse(isW, most, a),
            hn::IfThenElse(isW, a, hn::IfThenElse(isX, most, b)),
            hn::IfThenElse(hn::Or(isW, isX), b, hn::IfThenElse(isY, most, c)),
            hn::IfThenElse(isZ, most, c)};
}

HWY_INLINE void setOrientation(const QuaternionLanes& q, MotionStates& s, std::size_t fish) {
    Lanes best = q.w;
    IntLanes largest = hn::Zero(kInts);
    const auto consider = [&](Lanes component, int index) HWY_ATTR {
        const auto more = hn::Gt(hn::Abs(component), hn::Abs(best));
        best = hn::IfThenElse(more, component, best);
        largest = hn::IfThenElse(hn::RebindMask(kInts, more), hn::Set(kInts, index), largest);
    };
    consider(q.x, 1);
    consider(q.y, 2);
    consider(q.z, 3);
    const Lanes one = hn::Set(kFloats, 1.0F);
    const Lanes sign = hn::IfThenElse(hn::Lt(best, hn::Zero(kFloats)), hn::Neg(one), one);
    const auto put = [&](Lanes component, std::vector<std::int32_t>& column) HWY_ATTR {
        const Lanes units =
            hn::Mul(hn::Mul(sign, component), hn::Set(kFloats, kOrientationUnitsPerOne));
        hn::StoreU(rounded(bounded(units, kOrientationLimit)), kInts, column.data() + fish);
    };
    const auto isW = isLargest(largest, 0);
    put(hn::IfThenElse(isW, q.x, q.w), s.orientationA);
    put(hn::IfThenElse(hn::Or(isW, isLargest(largest, 1)), q.y, q.x), s.orientationB);
    put(hn::IfThenElse(isLargest(largest, 3), q.y, q.z), s.orientationC);
    const hn::Rebind<std::uint8_t, Ints> bytes;
    hn::StoreU(hn::DemoteTo(bytes, largest), bytes, s.orientationLargest.data() + fish);
}

HWY_INLINE Lanes levellingRoll(Lanes up, Lanes right) {
    const Lanes rate = hn::Set(kFloats, kRollRate);
    const Lanes gentle = bounded(hn::Mul(hn::Set(kFloats, kRollGain), right), kRollRate);
    const auto bellyUp = hn::Lt(up, hn::Zero(kFloats));
    const auto noseVertical =
        hn::Lt(sumOfProducts(up, up, right, right), hn::Set(kFloats, kNoseVerticalSquared));
    return hn::IfThenZeroElse(noseVertical,
                              hn::IfThenElse(bellyUp, hn::CopySign(rate, right), gentle));
}

HWY_INLINE VectorLanes halfSteering(const QuaternionLanes& m, Lanes pitchSine, Lanes yaw) {
    const Lanes one = hn::Set(kFloats, 1.0F);
    const Lanes two = hn::Set(kFloats, 2.0F);
    const Lanes half = hn::Set(kFloats, 0.5F);
    const Lanes forwardX = hn::Sub(one, hn::Mul(two, sumOfProducts(m.y, m.y, m.z, m.z)));
    const Lanes forwardY = hn::Mul(two, sumOfProducts(m.x, m.y, m.w, m.z));
    const Lanes forwardZ = hn::Mul(two, differenceOfProducts(m.x, m.z, m.w, m.y));
    const Lanes up = hn::Sub(one, hn::Mul(two, sumOfProducts(m.x, m.x, m.z, m.z)));
    const Lanes right = hn::Mul(two, differenceOfProducts(m.y, m.z, m.w, m.x));
    const Lanes wanted = bounded(pitchSine, kSteepestPitch);
    const Lanes pitch =
        bounded(hn::Mul(hn::Set(kFloats, kPitchGain), hn::Sub(wanted, forwardY)), kPitchRate);
    const Lanes levelZ = hn::Add(forwardX, hn::Set(kFloats, kLevelAxisBias));
    const Lanes squared = sumOfProducts(levelZ, levelZ, forwardZ, forwardZ);
    const Lanes alongLevel = hn::Div(pitch, hn::Sqrt(hn::Max(squared, hn::Set(kFloats, kTiniest))));
    const Lanes roll = levellingRoll(up, right);
    return {hn::Mul(half, differenceOfProducts(roll, forwardX, alongLevel, forwardZ)),
            hn::Mul(half, hn::Add(hn::Mul(roll, forwardY), yaw)),
            hn::Mul(half, sumOfProducts(roll, forwardZ, alongLevel, levelZ))};
}

HWY_INLINE Lanes commanded(const std::vector<std::int16_t>& column, std::size_t fish, float unit) {
    const hn::Rebind<std::int16_t, Ints> shorts;
    const IntLanes integers = hn::PromoteTo(kInts, hn::LoadU(shorts, column.data() + fish));
    return hn::Mul(hn::ConvertTo(kFloats, integers), hn::Set(kFloats, unit));
}

HWY_INLINE void move(std::vector<std::int32_t>& column, std::size_t fish, Lanes units) {
    std::int32_t* const position = column.data() + fish;
    const IntLanes step = rounded(bounded(units, kLongestStepUnits));
    hn::StoreU(hn::Add(hn::LoadU(kInts, position), step), kInts, position);
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
    VectorLanes travel{};
    Lanes padding{};
    hn::LoadInterleaved4(
        kFloats, block.translation + 4 * lane, travel.x, travel.y, travel.z, padding);
    const QuaternionLanes seenFrom = renormalisedLanes(quotient(orientationOf(s, fish), start));
    const VectorLanes moves = rotated(seenFrom, travel);
    const Lanes units =
        hn::Mul(hn::ConvertTo(kFloats, hn::Load(kInts, block.lengthMillimetres + lane)),
                hn::Set(kFloats, kUnitsPerMillimetre));
    move(s.x, fish, hn::Mul(moves.x, units));
    move(s.y, fish, hn::Mul(moves.y, units));
    move(s.z, fish, hn::Mul(moves.z, units));
    const QuaternionLanes swum = product(seenFrom, end);
    const VectorLanes steering = halfSteering(product(swum, bodyFromMean),
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
