// SPDX-License-Identifier: Apache-2.0
// The vectorised step: motor.cpp's step on as many fish at a time as the processor has lanes.
// Blocks of 64 fish go through it in passes: first the phases and the tables, where each fish reads
// its own segment, then the arithmetic, which is the same for all.
#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstring>

#include "common/motion/motor.h"
#include "common/motion/motor_tables.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/motion/motor_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "common/motion/motor_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aquarama::motion::HWY_NAMESPACE {
namespace {

// Fish in a block: as many as a 64-bit set holds. That is enough for one vector's arithmetic to
// hide the latency of another's.
constexpr std::size_t kBlockFish = 64;
using FishSet = std::uint64_t;  // bit i: fish i of the block

// The motion of a block of fish in this tick: phases and fractions of their cells, phase rates, and
// the travels, four floats for each fish, stored by slotOf() to be read as columns.
struct Block {
    HWY_ALIGN std::int32_t from[kBlockFish];
    HWY_ALIGN std::int32_t to[kBlockFish];
    HWY_ALIGN std::int32_t facts[kBlockFish];  // MotorTables::facts
    // Where the samples lie, in quaternions from the first segment's tables on.
    HWY_ALIGN std::int32_t startAt[kBlockFish];
    HWY_ALIGN std::int32_t endAt[kBlockFish];
    HWY_ALIGN std::int32_t swayAt[kBlockFish];
    HWY_ALIGN float atStart[kBlockFish];
    HWY_ALIGN float atEnd[kBlockFish];
    HWY_ALIGN std::int32_t rate[kBlockFish];
    HWY_ALIGN float start[4 * kBlockFish];
    HWY_ALIGN float end[4 * kBlockFish];
    HWY_ALIGN float bodyFromMean[4 * kBlockFish];
    HWY_ALIGN float left[4 * kBlockFish];  // translation and speed at the start
    HWY_ALIGN float reached[4 * kBlockFish];
    HWY_ALIGN std::int32_t lengthMillimetres[kBlockFish];
    // Values from one pass to the next, as columns.
    HWY_ALIGN float travel[3 * kBlockFish];
    HWY_ALIGN float faster[kBlockFish];
    HWY_ALIGN float swum[3 * kBlockFish];
    HWY_ALIGN float swumW[kBlockFish];
    HWY_ALIGN float forward[3 * kBlockFish];
    HWY_ALIGN float up[kBlockFish];
    HWY_ALIGN float right[kBlockFish];
};

HWY_INLINE void storeColumns(const VectorLanes& v, float* columns, std::size_t lane) {
    hn::Store(v.x, kFloats, columns + lane);
    hn::Store(v.y, kFloats, columns + kBlockFish + lane);
    hn::Store(v.z, kFloats, columns + 2 * kBlockFish + lane);
}

HWY_INLINE VectorLanes loadColumns(const float* columns, std::size_t lane) {
    return {hn::Load(kFloats, columns + lane),
            hn::Load(kFloats, columns + kBlockFish + lane),
            hn::Load(kFloats, columns + 2 * kBlockFish + lane)};
}

// Writes the travel of one fish that was computed by scalar code.
void store(const Travel& travel, Block& block, std::size_t i) {
    const auto put = [i](const auto& four, float* column) {
        static_assert(sizeof(four) == 4 * sizeof(float));
        std::memcpy(column + 4 * slotOf(i), &four, sizeof(four));
    };
    put(travel.start.rotation, block.start);
    put(travel.end.rotation, block.end);
    put(travel.bodyFromMean, block.bodyFromMean);
    put(travel.start.translationAndSpeed, block.left);
    put(travel.end.translationAndSpeed, block.reached);
    block.rate[i] = travel.rate;
}

// Bit i: lane i is set. At most 16 lanes, so two bytes hold them.
HWY_INLINE FishSet setOf(hn::Mask<Ints> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kInts, mask, bits);
    return bits[0] | FishSet{bits[1]} << 8U;
}

// Fish of a block that playOn() leaves to scalar code.
struct Restless {
    FishSet leaving = 0;  // those that may leave their segment in this tick
    FishSet warping = 0;
};

// advanceSegment() for a block, as if no fish left its segment.
HWY_INLINE Restless playOn(const MotorTables& tables,
                           const MotorColumns& columns,
                           std::size_t first,
                           std::size_t count,
                           Block& block) {
    const hn::Rebind<std::uint16_t, Ints> shorts;
    const hn::Rebind<std::int16_t, Ints> rates;
    const hn::Rebind<std::uint8_t, Ints> bytes;
    const auto bytesAt = [&](const std::uint8_t* column)
                             HWY_ATTR { return hn::PromoteTo(kInts, hn::LoadU(bytes, column)); };
    Restless restless;
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kInts)) {
        const std::size_t fish = first + lane;
        const IntLanes phase = hn::PromoteTo(kInts, hn::LoadU(shorts, columns.phase + fish));
        const IntLanes commanded = hn::PromoteTo(kInts, hn::LoadU(rates, columns.phaseRate + fish));
        const IntLanes segment = hn::PromoteTo(kInts, hn::LoadU(shorts, columns.segment + fish));
        const IntLanes facts = hn::GatherIndex(kInts, tables.facts.data(), segment);
        const IntLanes action = hn::And(facts, hn::Set(kInts, kActionOfFacts));
        const IntLanes turnRate = hn::ShiftRight<kTurnRateBit>(facts);
        const IntLanes wanted = bytesAt(columns.wanted + fish);
        const auto isToldAnother = hn::Ne(action, wanted);
        const auto turns = hn::Gt(turnRate, hn::Zero(kInts));
        const auto isToldATurn = hn::Gt(wanted, hn::Set(kInts, kFirstTurn - 1));
        const IntLanes rate = hn::IfThenElse(hn::And(turns, isToldAnother), turnRate, commanded);
        const IntLanes to = hn::Add(phase, rate);
        const IntLanes last = hn::IfThenElse(hn::Gt(action, hn::Set(kInts, kFirstStart - 1)),
                                             hn::Set(kInts, lastPhaseOf(Action::StartLeftSmall)),
                                             hn::Set(kInts, lastPhaseOf(Action::TurnLeftSharp)));
        const auto ends = hn::Gt(to, last);
        const auto leaves =
            hn::Or(hn::And(turns, ends), hn::AndNot(hn::AndNot(isToldATurn, turns), isToldAnother));
        const IntLanes warpFrame = bytesAt(columns.warpFrame + fish);
        const auto warps = hn::Ne(warpFrame, bytesAt(columns.warpLength + fish));
        restless.warping |= setOf(warps) << lane;
        restless.leaving |= setOf(hn::AndNot(warps, leaves)) << lane;
        hn::Store(phase, kInts, block.from + lane);
        hn::Store(to, kInts, block.to + lane);
        hn::Store(rate, kInts, block.rate + lane);
        hn::Store(facts, kInts, block.facts + lane);
        const IntLanes next = hn::And(to, hn::Set(kInts, 0xFFFF));
        hn::StoreU(
            hn::DemoteTo(shorts, hn::IfThenElse(warps, phase, next)), shorts, columns.phase + fish);
        const IntLanes frame = hn::Add(warpFrame, hn::IfThenElseZero(warps, hn::Set(kInts, 1)));
        hn::StoreU(hn::DemoteTo(bytes, frame), bytes, columns.warpFrame + fish);
    }
    return restless;
}

// For the fish that may leave their segment: takes back playOn()'s change of the phase and calls
// advanceSegment() on each. Adds those that warp now.
HWY_INLINE void settle(const MotorStep& step,
                       const MotorColumns& columns,
                       std::size_t first,
                       Restless& restless,
                       Block& block) {
    for (; restless.leaving != 0; restless.leaving &= restless.leaving - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(restless.leaving));
        columns.phase[first + i] = static_cast<std::uint16_t>(block.from[i]);
        const Playing playing = advanceSegment(*step.tables, columns, first + i);
        block.to[i] = playing.to;
        block.from[i] = playing.from;
        block.rate[i] = playing.to - playing.from;
        block.facts[i] = step.tables->facts[columns.segment[first + i]];
        restless.warping |= FishSet{playing.warps} << i;
    }
}

// fractionOf() for a block.
HWY_INLINE void fractionsOf(const std::int32_t* phases, std::size_t count, float* fractions) {
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kInts)) {
        const IntLanes inCell = hn::And(hn::Load(kInts, phases + lane), hn::Set(kInts, 1023));
        hn::Store(hn::Mul(hn::ConvertTo(kFloats, inCell), hn::Set(kFloats, kPhaseCellUnit)),
                  kFloats,
                  fractions + lane);
    }
}

// The eight numbers of a path sample or the four of a quaternion, in as many vectors as the
// instruction set needs.
constexpr hn::CappedTag<float, 8> kEight;
constexpr hn::CappedTag<float, 4> kFour;

// Numbers of two neighbouring samples, interpolated.
template <class Tag>
HWY_INLINE hn::Vec<Tag> between(Tag tag, const float* a, const float* b, float share) {
    const auto from = hn::LoadU(tag, a);
    const auto step = hn::Sub(hn::LoadU(tag, b), from);
    return hn::Add(from, hn::Mul(hn::Set(tag, share), step));
}

// Two neighbouring samples at q, interpolated.
HWY_INLINE void storeBetween(const Quaternion* q, float share, float* four) {
    for (std::size_t c = 0; c < 4; c += hn::Lanes(kFour)) {
        hn::Store(between(kFour, &q[0].w + c, &q[1].w + c, share), kFour, four + c);
    }
}

// Two neighbouring path samples, the first of which begins at `path`, interpolated.
template <class Tag>
HWY_INLINE void storeBetween(
    Tag tag, const Quaternion* path, float share, float* rotation, float* place) {
    const float* const a = &path[0].w;
    const float* const b = &path[2].w;
#if HWY_TARGET != HWY_SCALAR  // vectors of this target have no halves
    if constexpr (hn::MaxLanes(Tag()) == 8) {
        const hn::Half<Tag> half;
        const auto at = between(tag, a, b, share);
        hn::Store(hn::LowerHalf(half, at), half, rotation);
        hn::Store(hn::UpperHalf(half, at), half, place);
        return;
    }
#endif
    for (std::size_t c = 0; c < 4; c += hn::Lanes(tag)) {
        hn::Store(between(tag, a + c, b + c, share), tag, rotation + c);
        hn::Store(between(tag, a + c + 4, b + c + 4, share), tag, place + c);
    }
}

// Sizes in quaternions: of a segment's tables, of a path sample, and of all path samples.
constexpr auto kSegmentStride =
    static_cast<std::int32_t>(sizeof(SegmentTables) / sizeof(Quaternion));
constexpr auto kPathStride = static_cast<std::int32_t>(sizeof(PathSample) / sizeof(Quaternion));
constexpr auto kSwayFrom =
    static_cast<std::int32_t>(offsetof(SegmentTables, bodyFromMean) / sizeof(Quaternion));
static_assert(sizeof(SegmentTables) % sizeof(Quaternion) == 0);
static_assert(sizeof(PathSample) == 2 * sizeof(Quaternion));
static_assert(offsetof(SegmentTables, path) == 0);
static_assert(kSwayFrom == kPathStride * static_cast<std::int32_t>(kPathSamples));

// Where the samples of a block's fish lie.
HWY_INLINE void findSamples(const MotorColumns& columns,
                            std::size_t first,
                            std::size_t count,
                            Block& block) {
    const hn::Rebind<std::uint16_t, Ints> shorts;
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kInts)) {
        const IntLanes segment =
            hn::PromoteTo(kInts, hn::LoadU(shorts, columns.segment + first + lane));
        const IntLanes tables = hn::Mul(segment, hn::Set(kInts, kSegmentStride));
        const auto cellOf = [&](const std::int32_t* phases) HWY_ATTR {
            return hn::ShiftRight<kPhaseCellBits>(hn::Load(kInts, phases + lane));
        };
        const IntLanes start = hn::Mul(cellOf(block.from), hn::Set(kInts, kPathStride));
        const IntLanes end = cellOf(block.to);
        const IntLanes sway =
            hn::Add(hn::And(end, hn::Set(kInts, kPhases - 1)), hn::Set(kInts, kSwayFrom));
        hn::Store(hn::Add(tables, start), kInts, block.startAt + lane);
        hn::Store(
            hn::Add(tables, hn::Mul(end, hn::Set(kInts, kPathStride))), kInts, block.endAt + lane);
        hn::Store(hn::Add(tables, sway), kInts, block.swayAt + lane);
    }
}

// playedTravel() of fish i of the block, whose samples and fractions are known. `slot` is
// slotOf(i).
HWY_INLINE void storePlayed(const Quaternion* tables,
                            Block& block,
                            std::size_t i,
                            std::size_t slot) {
    const auto at = [tables](std::int32_t place) { return tables + place; };
    const std::size_t to = 4 * slot;
    storeBetween(kEight, at(block.startAt[i]), block.atStart[i], block.start + to, block.left + to);
    storeBetween(kEight, at(block.endAt[i]), block.atEnd[i], block.end + to, block.reached + to);
    storeBetween(at(block.swayAt[i]), block.atEnd[i], block.bodyFromMean + to);
}

// Fills the block for `count` fish from `first` on, a multiple of kWidestLanes. Warping fish are
// computed as if they played, which costs less than a branch for each fish; then theirs is
// overwritten.
HWY_INLINE void travelBlock(const MotorStep& step,
                            const MotorColumns& columns,
                            std::size_t first,
                            std::size_t count,
                            Block& block) {
    Restless restless = playOn(*step.tables, columns, first, count, block);
    settle(step, columns, first, restless, block);
    fractionsOf(block.from, count, block.atStart);
    fractionsOf(block.to, count, block.atEnd);
    findSamples(columns, first, count, block);
    const Quaternion* const tables = &step.tables->segments[0].path[0].rotation;
    // Four fish at a time lie as far apart as the slots of the first two.
    const std::size_t apart = slotOf(1) - slotOf(0);
    for (std::size_t i = 0; i < count; i += 4) {
        const std::size_t slot = slotOf(i);
        for (std::size_t k = 0; k < 4; ++k) {
            storePlayed(tables, block, i + k, slot + k * apart);
            block.lengthMillimetres[i + k] = step.traits[first + i + k].lengthMillimetres;
        }
    }
    for (; restless.warping != 0; restless.warping &= restless.warping - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(restless.warping));
        store(warpingTravel(*step.tables, columns, first + i), block, i);
    }
}

// The arithmetic runs in three passes over a block, each a chain of dependent operations short
// enough that the processor works on several vectors at once. The lanes of `block` from `lane` on
// are the fish from `fish` on. First pass: the speeds after the tick, and the travel along the
// path.
HWY_INLINE void changeSpeed(const MotorStep& step,
                            Block& block,
                            std::size_t lane,
                            std::size_t fish) {
    MotionStates& s = *step.states;
    const Lanes rate = hn::ConvertTo(kFloats, hn::Load(kInts, block.rate + lane));
    const PlaceLanes left = loadPlace(block.left + 4 * lane);
    const PlaceLanes reached = loadPlace(block.reached + 4 * lane);
    const Lanes pathAtEnd = pathSpeed(reached.speed, rate);
    const IntLanes brake = bytesAt(step.commands->brake, fish);
    const Lanes speed =
        speedAfter(step.tables->loss,
                   hn::ConvertTo(kFloats, hn::LoadU(kInts, s.speed.data() + fish)),
                   pathSpeed(left.speed, rate),
                   pathAtEnd,
                   segmentsAt(s.segment, fish),
                   hn::Mul(hn::ConvertTo(kFloats, brake), hn::Set(kFloats, kBrakeUnit)));
    follow(s.spread, brake, kSpreadStep, fish);
    follow(s.mouth, bytesAt(step.commands->mouth, fish), kMouthStep, fish);
    followGaze(s.gaze, bytesAt(step.commands->gaze, fish), fish);
    hn::StoreU(hn::ConvertTo(kInts, speed), kInts, s.speed.data() + fish);
    const Lanes share = shareOfPath(speed, pathAtEnd);
    const Lanes faster =
        hn::Mul(hn::Sub(speed, hn::Mul(share, pathAtEnd)), hn::Set(kFloats, kLengthsPerSpeedUnit));
    hn::Store(faster, kFloats, block.faster + lane);
    const auto travelled = [&](Lanes from, Lanes to)
                               HWY_ATTR { return hn::Mul(share, hn::Sub(to, from)); };
    storeColumns({travelled(left.translation.x, reached.translation.x),
                  travelled(left.translation.y, reached.translation.y),
                  travelled(left.translation.z, reached.translation.z)},
                 block.travel,
                 lane);
}

// Second pass: eq. 10 and 11, positions and attitudes.
HWY_INLINE void swim(const MotorStep& step, Block& block, std::size_t lane, std::size_t fish) {
    MotionStates& s = *step.states;
    const QuaternionLanes start = load(block.start + 4 * lane);
    const QuaternionLanes end = load(block.end + 4 * lane);
    const QuaternionLanes bodyFromMean = load(block.bodyFromMean + 4 * lane);
    const QuaternionLanes seenFrom = renormalisedLanes(quotient(orientationOf(s, fish), start));
    const QuaternionLanes swum = product(seenFrom, end);
    const AttitudeLanes attitude = attitudeOf(renormalisedLanes(product(swum, bodyFromMean)));
    const VectorLanes moves = rotated(seenFrom, loadColumns(block.travel, lane));
    const Lanes faster = hn::Load(kFloats, block.faster + lane);
    const Lanes units =
        hn::Mul(hn::ConvertTo(kFloats, hn::Load(kInts, block.lengthMillimetres + lane)),
                hn::Set(kFloats, kUnitsPerMillimetre));
    move(s.x, fish, hn::Mul(hn::Add(moves.x, hn::Mul(faster, attitude.forward.x)), units));
    move(s.y, fish, hn::Mul(hn::Add(moves.y, hn::Mul(faster, attitude.forward.y)), units));
    move(s.z, fish, hn::Mul(hn::Add(moves.z, hn::Mul(faster, attitude.forward.z)), units));
    storeColumns({swum.x, swum.y, swum.z}, block.swum, lane);
    hn::Store(swum.w, kFloats, block.swumW + lane);
    storeColumns(attitude.forward, block.forward, lane);
    hn::Store(attitude.up, kFloats, block.up + lane);
    hn::Store(attitude.right, kFloats, block.right + lane);
}

// Third pass: the fish's own steering, and the new orientations.
HWY_INLINE void steer(const MotorStep& step,
                      const Block& block,
                      std::size_t lane,
                      std::size_t fish) {
    const VectorLanes swum = loadColumns(block.swum, lane);
    const AttitudeLanes attitude{loadColumns(block.forward, lane),
                                 hn::Load(kFloats, block.up + lane),
                                 hn::Load(kFloats, block.right + lane)};
    // The rate is the same in all segments in which it is not 0.
    const auto pitches =
        hn::TestBit(hn::Load(kInts, block.facts + lane), hn::Set(kInts, kPitchesInAddition));
    const Lanes pitchRate = hn::IfThenElseZero(
        hn::RebindMask(kFloats, pitches),
        hn::Set(kFloats, step.tables->pitchRate[firstSegmentOf(Action::ForwardMedium)]));
    const VectorLanes steering = halfSteering(attitude,
                                              commanded(step.commands->pitch, fish, kPitchUnit),
                                              pitchRate,
                                              commanded(step.commands->yawRate, fish, kYawUnit));
    const QuaternionLanes turn{hn::Set(kFloats, 1.0F), steering.x, steering.y, steering.z};
    const QuaternionLanes swam{hn::Load(kFloats, block.swumW + lane), swum.x, swum.y, swum.z};
    setOrientation(renormalisedLanes(product(turn, swam)), *step.states, fish);
}

}  // namespace

// step.last - step.first: a multiple of kWidestLanes.
void stepVectors(const MotorStep& step) {
    const MotorColumns columns = columnsOf(*step.commands, *step.states);
    Block block;
    for (std::size_t fish = step.first; fish < step.last; fish += kBlockFish) {
        const std::size_t count = std::min(kBlockFish, step.last - fish);
        travelBlock(step, columns, fish, count, block);
        const auto inVectors = [count](auto&& pass) HWY_ATTR {
            for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kFloats)) pass(lane);
        };
        inVectors([&](std::size_t lane) HWY_ATTR { changeSpeed(step, block, lane, fish + lane); });
        inVectors([&](std::size_t lane) HWY_ATTR { swim(step, block, lane, fish + lane); });
        inVectors([&](std::size_t lane) HWY_ATTR { steer(step, block, lane, fish + lane); });
    }
}

}  // namespace aquarama::motion::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aquarama::motion {

HWY_EXPORT(stepVectors);

namespace {

// Moves the fish with the water. The compiler makes vectors of it: sums of integers, which wrap
// around as moved() does.
void carry(const MotorStep& step) {
    const auto along = [&](std::vector<std::int32_t>& position,
                           const std::vector<std::int32_t>& way) {
        for (std::size_t fish = step.first; fish < step.last; ++fish)
            position[fish] = static_cast<std::int32_t>(static_cast<std::uint32_t>(position[fish]) +
                                                       static_cast<std::uint32_t>(way[fish]));
    };
    along(step.states->x, step.advection->x);
    along(step.states->y, step.advection->y);
    along(step.states->z, step.advection->z);
}

}  // namespace

void MotorStep::run() const {
    assert(tables != nullptr);
    assert(commands != nullptr);
    assert(states != nullptr);
    assert(first <= last);
    assert(last <= states->size());
    assert(last <= traits.size());
    assert(last <= commands->action.size());
    MotorStep vectors = *this;
    vectors.last = last - (last - first) % kWidestLanes;
    HWY_DYNAMIC_DISPATCH(stepVectors)(vectors);
    if (advection != nullptr) carry(vectors);
    MotorStep rest = *this;
    rest.first = vectors.last;
    rest.runReference();
}

}  // namespace aquarama::motion
#endif
