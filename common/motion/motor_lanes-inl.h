// SPDX-License-Identifier: Apache-2.0
// The arithmetic of motor.cpp and motion_state.h on vectors of fish, operation for operation. A
// function here has the name of its scalar counterpart, where the meaning is explained. Elementwise
// only, and no fused multiply-add: so every vector width gives the same bits. Change both together.

// Included once for each instruction set, by motor_simd.cpp.
#if defined(AQUARAMA_MOTOR_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AQUARAMA_MOTOR_LANES_INL_H
#undef AQUARAMA_MOTOR_LANES_INL_H
#else
#define AQUARAMA_MOTOR_LANES_INL_H
#endif

#include <hwy/highway.h>

#include "common/motion/motor_tables.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::motion::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// One lane is one fish. At most kWidestLanes, so that a range splits alike on every machine.
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
// Translation and speed of a PathSample.
struct PlaceLanes {
    VectorLanes translation;
    Lanes speed;
};

HWY_INLINE Lanes sumOfProducts(Lanes a, Lanes b, Lanes c, Lanes d) {
    return hn::Add(hn::Mul(a, b), hn::Mul(c, d));
}
HWY_INLINE Lanes differenceOfProducts(Lanes a, Lanes b, Lanes c, Lanes d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
HWY_INLINE Lanes bounded(Lanes value, float limit) {
    return hn::Min(hn::Max(value, hn::Set(kFloats, -limit)), hn::Set(kFloats, limit));
}

HWY_INLINE Lanes bounded(Lanes value, Lanes limit) {
    return hn::Min(hn::Max(value, hn::Neg(limit)), limit);
}

// To the nearest even integer, for |value| up to 2^22: the last bit of the sum is worth one, so the
// bits of the sum less those of the shift are the integer.
HWY_INLINE IntLanes rounded(Lanes value) {
    const Lanes shift = hn::Set(kFloats, 12582912.0F);  // 1.5 * 2^23
    return hn::Sub(hn::BitCast(kInts, hn::Add(value, shift)), hn::BitCast(kInts, shift));
}

// Groups of four floats, one for each fish of a block, are stored in an order from which load() can
// transpose them without crossing 128-bit borders: slotOf(i) is the place of the group of fish i.
HWY_INLINE std::size_t slotOf(std::size_t i) {
    const std::size_t lanes = hn::Lanes(kFloats);
    if (lanes < 4) return i;
    const std::size_t inVector = i % lanes;
    return i - inVector + inVector % 4 * (lanes / 4) + inVector / 4;
}

// Reads the groups of one vector of fish, stored by slotOf(), as four columns: 4 x 4 transpositions
// within each 128 bits.
HWY_INLINE QuaternionLanes load(const float* fours) {
#if HWY_TARGET == HWY_SCALAR
    QuaternionLanes q{};
    hn::LoadInterleaved4(kFloats, fours, q.w, q.x, q.y, q.z);
    return q;
#else
    const hn::Repartition<double, Floats> pairs;
    const std::size_t lanes = hn::Lanes(kFloats);
    const auto row = [&](std::size_t r) HWY_ATTR { return hn::Load(kFloats, fours + r * lanes); };
    const auto lower = [&](std::size_t r) HWY_ATTR {
        return hn::BitCast(pairs, hn::InterleaveLower(kFloats, row(r), row(r + 1)));
    };
    const auto upper = [&](std::size_t r) HWY_ATTR {
        return hn::BitCast(pairs, hn::InterleaveUpper(kFloats, row(r), row(r + 1)));
    };
    return {hn::BitCast(kFloats, hn::InterleaveLower(pairs, lower(0), lower(2))),
            hn::BitCast(kFloats, hn::InterleaveUpper(pairs, lower(0), lower(2))),
            hn::BitCast(kFloats, hn::InterleaveLower(pairs, upper(0), upper(2))),
            hn::BitCast(kFloats, hn::InterleaveUpper(pairs, upper(0), upper(2)))};
#endif
}

HWY_INLINE PlaceLanes loadPlace(const float* translationsAndSpeeds) {
    const QuaternionLanes four = load(translationsAndSpeeds);
    return {{four.w, four.x, four.y}, four.z};
}

HWY_INLINE QuaternionLanes product(const QuaternionLanes& a, const QuaternionLanes& b) {
    return {hn::Sub(differenceOfProducts(a.w, b.w, a.x, b.x), sumOfProducts(a.y, b.y, a.z, b.z)),
            hn::Add(sumOfProducts(a.w, b.x, a.x, b.w), differenceOfProducts(a.y, b.z, a.z, b.y)),
            hn::Add(sumOfProducts(a.w, b.y, a.y, b.w), differenceOfProducts(a.z, b.x, a.x, b.z)),
            hn::Add(sumOfProducts(a.w, b.z, a.z, b.w), differenceOfProducts(a.x, b.y, a.y, b.x))};
}

// a times the conjugate of b. The signs are moved into the sums, which changes no bit.
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

// Columns of MotionStates from some fish on.
struct OrientationColumns {
    const std::int32_t *a, *b, *c;
    const std::uint8_t* largest;
};

// Reads and unpacks the orientations of a vector of fish: unpack() without branches.
HWY_INLINE QuaternionLanes orientationOf(const OrientationColumns& columns) {
    const auto component = [](const std::int32_t* column) HWY_ATTR {
        return hn::Mul(hn::ConvertTo(kFloats, hn::LoadU(kInts, column)),
                       hn::Set(kFloats, kOrientationUnit));
    };
    const hn::Rebind<std::uint8_t, Ints> bytes;
    const IntLanes largest = hn::PromoteTo(kInts, hn::LoadU(bytes, columns.largest));
    const Lanes a = component(columns.a);
    const Lanes b = component(columns.b);
    const Lanes c = component(columns.c);
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

HWY_INLINE QuaternionLanes orientationOf(const MotionStates& s, std::size_t fish) {
    return orientationOf({s.orientationA.data() + fish,
                          s.orientationB.data() + fish,
                          s.orientationC.data() + fish,
                          s.orientationLargest.data() + fish});
}

// Packs and writes them: pack() without branches. Strictly greater wins, so the first of equal
// components is left out here too.
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

struct AttitudeLanes {
    VectorLanes forward;
    Lanes up, right;
};

HWY_INLINE AttitudeLanes attitudeOf(const QuaternionLanes& m) {
    const Lanes one = hn::Set(kFloats, 1.0F);
    const Lanes two = hn::Set(kFloats, 2.0F);
    return {{hn::Sub(one, hn::Mul(two, sumOfProducts(m.y, m.y, m.z, m.z))),
             hn::Mul(two, sumOfProducts(m.x, m.y, m.w, m.z)),
             hn::Mul(two, differenceOfProducts(m.x, m.z, m.w, m.y))},
            hn::Sub(one, hn::Mul(two, sumOfProducts(m.x, m.x, m.z, m.z))),
            hn::Mul(two, differenceOfProducts(m.y, m.z, m.w, m.x))};
}

HWY_INLINE Lanes inverseRoot(Lanes value) {
    const hn::RebindToUnsigned<Floats> bits;
    const auto halved = hn::ShiftRight<1>(hn::BitCast(bits, value));
    Lanes root = hn::BitCast(kFloats, hn::Sub(hn::Set(bits, kInverseRootGuess), halved));
    const Lanes half = hn::Mul(hn::Set(kFloats, 0.5F), value);
    for (int step = 0; step < 2; ++step) {
        const Lanes square = hn::Mul(root, root);
        root = hn::Mul(root, hn::Sub(hn::Set(kFloats, 1.5F), hn::Mul(half, square)));
    }
    return root;
}

HWY_INLINE VectorLanes halfSteering(const AttitudeLanes& attitude,
                                    Lanes pitchSine,
                                    Lanes pitchRate,
                                    Lanes yaw) {
    const auto& [forwardX, forwardY, forwardZ] = attitude.forward;
    const Lanes half = hn::Set(kFloats, 0.5F);
    const Lanes wanted = bounded(pitchSine, kSteepestPitch);
    const Lanes pitch =
        bounded(hn::Mul(hn::Set(kFloats, kPitchGain), hn::Sub(wanted, forwardY)), pitchRate);
    const Lanes levelZ = hn::Add(forwardX, hn::Set(kFloats, kLevelAxisBias));
    const Lanes squared = sumOfProducts(levelZ, levelZ, forwardZ, forwardZ);
    const Lanes alongLevel =
        hn::Mul(pitch, inverseRoot(hn::Max(squared, hn::Set(kFloats, kTiniest))));
    const Lanes roll = levellingRoll(attitude.up, attitude.right);
    return {hn::Mul(half, differenceOfProducts(roll, forwardX, alongLevel, forwardZ)),
            hn::Mul(half, hn::Add(hn::Mul(roll, forwardY), yaw)),
            hn::Mul(half, sumOfProducts(roll, forwardZ, alongLevel, levelZ))};
}

// Rounds by adding and subtracting the shift, as roundToEven() does: |value| up to 2^22.
HWY_INLINE Lanes pathSpeed(Lanes perRate, Lanes rate) {
    const Lanes shift = hn::Set(kFloats, 12582912.0F);  // 1.5 * 2^23
    return hn::Sub(hn::Add(bounded(hn::Mul(perRate, rate), kFastest), shift), shift);
}

HWY_INLINE Lanes approached(Lanes v, Lanes target, Lanes step) {
    const Lanes whole = hn::Ceil(step);
    return hn::IfThenElse(
        hn::Lt(v, target), hn::Min(hn::Add(v, whole), target), hn::Max(hn::Sub(v, whole), target));
}

HWY_INLINE Lanes shareOfPath(Lanes speed, Lanes path) {
    const Lanes one = hn::Set(kFloats, 1.0F);
    const Lanes share = hn::Min(hn::Max(hn::Div(speed, path), hn::Zero(kFloats)), one);
    return hn::IfThenElse(hn::Eq(path, hn::Zero(kFloats)), one, share);
}

HWY_INLINE Lanes speedAfter(const SpeedLoss& loss,
                            Lanes v,
                            Lanes pathAtStart,
                            Lanes pathAtEnd,
                            IntLanes segment,
                            Lanes brake) {
    const IntLanes glide = hn::Set(kInts, firstSegmentOf(Action::Glide));
    const auto glides = hn::Or(hn::RebindMask(kFloats, hn::Eq(segment, glide)),
                               hn::Eq(pathAtEnd, hn::Zero(kFloats)));
    const Lanes ahead = hn::Max(pathAtStart, hn::Zero(kFloats));
    const Lanes gain = hn::Sub(hn::Max(pathAtEnd, hn::Zero(kFloats)), ahead);
    const Lanes change =
        hn::IfThenElse(hn::Lt(gain, hn::Zero(kFloats)), hn::Mul(shareOfPath(v, ahead), gain), gain);
    const Lanes changed = hn::Add(v, change);
    const Lanes carried = bounded(hn::Max(changed, hn::Min(v, hn::Zero(kFloats))), kFastest);
    const Lanes target = hn::IfThenZeroElse(glides, pathAtEnd);
    const Lanes zero = hn::Zero(kFloats);
    const Lanes excess =
        hn::IfThenElseZero(hn::Gt(target, zero), hn::Max(hn::Sub(carried, target), zero));
    const Lanes swimming = hn::Add(hn::Abs(target), hn::Mul(hn::Set(kFloats, kExcessDrag), excess));
    const Lanes against = hn::IfThenElse(glides, carried, swimming);
    const Lanes drag = hn::GatherIndex(
        kFloats, loss.drag.data(), hn::IfThenElse(hn::RebindMask(kInts, glides), glide, segment));
    const Lanes step = hn::Mul(drag, hn::Abs(hn::Mul(against, hn::Sub(target, carried))));
    const Lanes swum = approached(carried, target, step);
    const Lanes spread = hn::Mul(brake, hn::Set(kFloats, loss.brake));
    return approached(swum, hn::Zero(kFloats), hn::Mul(spread, hn::Abs(swum)));
}

// A 16-bit column of the commands as floats.
HWY_INLINE Lanes commanded(const std::vector<std::int16_t>& column, std::size_t fish, float unit) {
    const hn::Rebind<std::int16_t, Ints> shorts;
    const IntLanes integers = hn::PromoteTo(kInts, hn::LoadU(shorts, column.data() + fish));
    return hn::Mul(hn::ConvertTo(kFloats, integers), hn::Set(kFloats, unit));
}

HWY_INLINE IntLanes bytesAt(const std::vector<std::uint8_t>& column, std::size_t fish) {
    const hn::Rebind<std::uint8_t, Ints> bytes;
    return hn::PromoteTo(kInts, hn::LoadU(bytes, column.data() + fish));
}

HWY_INLINE IntLanes segmentsAt(const std::vector<std::uint16_t>& column, std::size_t fish) {
    const hn::Rebind<std::uint16_t, Ints> shorts;
    return hn::PromoteTo(kInts, hn::LoadU(shorts, column.data() + fish));
}

// No further from zero than `most`.
HWY_INLINE IntLanes within(IntLanes step, int most) {
    return hn::Min(hn::Max(step, hn::Set(kInts, -most)), hn::Set(kInts, most));
}

// followed() of a vector of fish.
HWY_INLINE void follow(std::vector<std::uint8_t>& column,
                       IntLanes commanded,
                       int most,
                       std::size_t fish) {
    const hn::Rebind<std::uint8_t, Ints> bytes;
    const IntLanes present = bytesAt(column, fish);
    const IntLanes step = within(hn::Sub(commanded, present), most);
    hn::StoreU(hn::DemoteTo(bytes, hn::Add(present, step)), bytes, column.data() + fish);
}

// gazeAfter() of a vector of fish.
HWY_INLINE void followGaze(std::vector<std::uint8_t>& column,
                           IntLanes commanded,
                           std::size_t fish) {
    const hn::Rebind<std::uint8_t, Ints> bytes;
    const auto nibble = [](IntLanes bits)
                            HWY_ATTR { return hn::ShiftRight<28>(hn::ShiftLeft<28>(bits)); };
    const IntLanes present = bytesAt(column, fish);
    const IntLanes up = hn::ShiftRight<4>(present);
    const IntLanes aside = hn::Add(present, within(nibble(hn::Sub(commanded, present)), 1));
    const IntLanes climb = hn::Sub(nibble(hn::ShiftRight<4>(commanded)), nibble(up));
    const IntLanes low = hn::Set(kInts, 15);
    const IntLanes gaze =
        hn::Or(hn::And(aside, low), hn::ShiftLeft<4>(hn::And(hn::Add(up, within(climb, 1)), low)));
    hn::StoreU(hn::DemoteTo(bytes, gaze), bytes, column.data() + fish);
}

// Adds a step to one coordinate. Integer lanes wrap around, as moved() does.
HWY_INLINE void move(std::vector<std::int32_t>& column, std::size_t fish, Lanes units) {
    std::int32_t* const position = column.data() + fish;
    const IntLanes step = rounded(bounded(units, kLongestStepUnits));
    hn::StoreU(hn::Add(hn::LoadU(kInts, position), step), kInts, position);
}

}  // namespace
}  // namespace aquarama::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
