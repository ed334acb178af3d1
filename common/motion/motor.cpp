// SPDX-License-Identifier: Apache-2.0
// The plain step, one fish at a time. It defines the order of operations: motor_lanes-inl.h repeats
// it, so any change here has to be made there too.
#include "common/motion/motor.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "common/motion/gaze.h"
#include "common/motion/headings.h"
#include "common/motion/motor_tables.h"

namespace aquarama::motion {
namespace {

// Along the recorded path from one phase to another, up to a cycle later or earlier. The path has
// two cycles, so neither phase wraps around.
Travel playedTravel(const SegmentTables& tables, const Playing& playing) {
    const auto placeAt = [&](std::int32_t phase) {
        const auto at = static_cast<std::uint32_t>(phase);
        const PathSample* cell = &tables.path[at >> kPhaseCellBits];
        return lerp(cell[0], cell[1], fractionOf(at));
    };
    return {.start = placeAt(playing.from),
            .end = placeAt(playing.to),
            .bodyFromMean = swayAt(tables, static_cast<std::uint32_t>(playing.to) & 0xFFFFU),
            .rate = playing.to - playing.from};
}

float bounded(float value, float limit) {
    return std::min(std::max(value, -limit), limit);
}

// The balancing roll about the nose (paper, section 4.2), radians in a tick, from the heights of
// the fish's own up and right: towards upright, at full rate while belly-up, and none where the
// nose is vertical.
float levellingRoll(float up, float right) {
    if (up * up + right * right < kNoseVerticalSquared) return 0.0F;
    if (up < 0.0F) return std::copysign(kRollRate, right);
    return bounded(kRollGain * right, kRollRate);
}

// The direction of the mean frame's x axis in the world, and the heights of its up and right.
struct Attitude {
    Vector forward;
    float up, right;
};

// The first column of the rotation matrix of m, and the y components of its second and third.
Attitude attitudeOf(const Quaternion& m) {
    return {{1.0F - 2.0F * (m.y * m.y + m.z * m.z),
             2.0F * (m.x * m.y + m.w * m.z),
             2.0F * (m.x * m.z - m.w * m.y)},
            1.0F - 2.0F * (m.x * m.x + m.z * m.z),
            2.0F * (m.y * m.z - m.w * m.x)};
}

// 1 / sqrt within 5 millionths: a guess from the exponent and two Newton steps, which cost less
// than a square root and a division.
float inverseRoot(float value) {
    const std::uint32_t halved = std::bit_cast<std::uint32_t>(value) >> 1U;
    float root = std::bit_cast<float>(kInverseRootGuess - halved);
    const float half = 0.5F * value;
    for (int step = 0; step < 2; ++step) root = root * (1.5F - half * (root * root));
    return root;
}

// Half the turn (radians, about world axes) that the fish adds in this tick: commanded yaw about
// up, pitch about the level axis to its right, roll about its nose. It is measured on the mean
// frame; otherwise the fish would steer against its own tail beat.
Vector halfSteering(const Attitude& attitude, float pitchSine, float pitchRate, float yaw) {
    const auto& [forwardX, forwardY, forwardZ] = attitude.forward;
    const float wanted = bounded(pitchSine, kSteepestPitch);
    const float pitch = bounded(kPitchGain * (wanted - forwardY), pitchRate);
    const float levelZ = forwardX + kLevelAxisBias;
    const float squared = levelZ * levelZ + forwardZ * forwardZ;
    const float alongLevel = pitch * inverseRoot(std::max(squared, kTiniest));
    const float roll = levellingRoll(attitude.up, attitude.right);
    return {0.5F * (roll * forwardX - alongLevel * forwardZ),
            0.5F * (roll * forwardY + yaw),
            0.5F * (roll * forwardZ + alongLevel * levelZ)};
}

// Moves v towards target and not beyond, by the step rounded up to a whole unit: so rounding never
// makes it stop short of the target.
float approached(float v, float target, float step) {
    const float whole = std::ceil(step);
    return v < target ? std::min(v + whole, target) : std::max(v - whole, target);
}

// The share of its path that a fish travels, 0 to 1: none where it still goes the other way.
float shareOfPath(float speed, float path) {
    if (path == 0.0F) return 1.0F;
    return std::min(std::max(speed / path, 0.0F), 1.0F);
}

// The speed after a tick, from v and the path's at the tick's start and end; all in whole units.
// First, v gains what the path's speed gains, as from a stroke of the tail, and of what that loses
// the fish's share of the path: so a turn takes no more speed than there is, and one begun slowly
// never drives the fish backwards. A path that goes back for a moment counts as one that stands.
// Then the rest of the difference decays by the law of SpeedResponse; in a glide the target is 0,
// and a fish whose tail rests glides. Last, spread fins brake.
float speedAfter(const SpeedLoss& loss,
                 float v,
                 float pathAtStart,
                 float pathAtEnd,
                 std::uint16_t segment,
                 float brake) {
    constexpr std::uint16_t kGlide = firstSegmentOf(Action::Glide);
    const bool glides = segment == kGlide || pathAtEnd == 0.0F;
    const float ahead = std::max(pathAtStart, 0.0F);
    const float gain = std::max(pathAtEnd, 0.0F) - ahead;
    const float change = gain < 0.0F ? shareOfPath(v, ahead) * gain : gain;
    const float carried = bounded(std::max(v + change, std::min(v, 0.0F)), kFastest);
    const float target = glides ? 0.0F : pathAtEnd;
    const float excess = target > 0.0F ? std::max(carried - target, 0.0F) : 0.0F;
    const float against = glides ? carried : std::abs(target) + kExcessDrag * excess;
    const float drag = loss.drag[glides ? kGlide : segment];
    const float step = drag * std::abs(against * (target - carried));
    const float swum = approached(carried, target, step);
    return approached(swum, 0.0F, (brake * loss.brake) * std::abs(swum));
}

// A column after a tick: nearer to what is commanded by `most` or less.
std::uint8_t followed(std::uint8_t present, std::uint8_t commanded, int most) {
    const int step = std::clamp(int{commanded} - int{present}, -most, most);
    return static_cast<std::uint8_t>(present + step);
}

// A travel as whole position units.
std::int32_t stepUnits(float units) {
    return static_cast<std::int32_t>(roundToEven(bounded(units, kLongestStepUnits)));
}

// Addition that wraps around: the world has no edge to overflow at. Signed overflow would be
// undefined.
std::int32_t moved(std::int32_t position, std::int32_t step) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(position) +
                                     static_cast<std::uint32_t>(step));
}

Quaternion unpackedOrientation(const MotionStates& s, std::size_t i) {
    return unpack(
        {{s.orientationA[i], s.orientationB[i], s.orientationC[i]}, s.orientationLargest[i]});
}

// One tick of fish i: the whole of the motor, as the comments of MotorStep describe it.
void stepFish(const MotorStep& step, const MotorColumns& columns, std::size_t i) {
    MotionStates& s = *step.states;
    const Playing playing = advanceSegment(*step.tables, columns, i);
    const Travel travel = playing.warps
                              ? warpingTravel(*step.tables, columns, i)
                              : playedTravel(step.tables->segments[s.segment[i]], playing);
    const auto& a = travel.start.translationAndSpeed;
    const auto& b = travel.end.translationAndSpeed;
    const auto rate = static_cast<float>(travel.rate);
    const float pathAtEnd = pathSpeed(b[3], rate);
    const float speed = speedAfter(step.tables->loss,
                                   static_cast<float>(s.speed[i]),
                                   pathSpeed(a[3], rate),
                                   pathAtEnd,
                                   s.segment[i],
                                   static_cast<float>(step.commands->brake[i]) * kBrakeUnit);
    s.speed[i] = static_cast<std::int32_t>(speed);
    s.spread[i] = followed(s.spread[i], step.commands->brake[i], kSpreadStep);
    s.mouth[i] = followed(s.mouth[i], step.commands->mouth[i], kMouthStep);
    s.gaze[i] = gazeAfter(s.gaze[i], step.commands->gaze[i]);
    // Eq. 10 in body axes. seenFrom is the frame from which the path is seen, in the world.
    const Quaternion seenFrom =
        renormalised(unpackedOrientation(s, i) * conjugate(travel.start.rotation));
    const Quaternion swum = seenFrom * travel.end.rotation;
    const Attitude attitude = attitudeOf(renormalised(swum * travel.bodyFromMean));
    // Eq. 11 with the fish's own length: a slower fish travels a share of the path, a faster one
    // goes on along its nose.
    const float share = shareOfPath(speed, pathAtEnd);
    const Vector moves =
        rotated(seenFrom, {share * (b[0] - a[0]), share * (b[1] - a[1]), share * (b[2] - a[2])});
    const float faster = (speed - share * pathAtEnd) * kLengthsPerSpeedUnit;
    const float units = static_cast<float>(step.traits[i].lengthMillimetres) * kUnitsPerMillimetre;
    s.x[i] = moved(s.x[i], stepUnits((moves[0] + faster * attitude.forward[0]) * units));
    s.y[i] = moved(s.y[i], stepUnits((moves[1] + faster * attitude.forward[1]) * units));
    s.z[i] = moved(s.z[i], stepUnits((moves[2] + faster * attitude.forward[2]) * units));
    // Last, the fish's own steering, as a quaternion of small angle: 1 and half the turn.
    const Vector steering = halfSteering(attitude,
                                         static_cast<float>(step.commands->pitch[i]) * kPitchUnit,
                                         step.tables->pitchRate[s.segment[i]],
                                         static_cast<float>(step.commands->yawRate[i]) * kYawUnit);
    const Quaternion turn{1.0F, steering[0], steering[1], steering[2]};
    const PackedOrientation packed = pack(renormalised(turn * swum));
    s.orientationA[i] = packed.abc[0];
    s.orientationB[i] = packed.abc[1];
    s.orientationC[i] = packed.abc[2];
    s.orientationLargest[i] = packed.largest;
}

// Fish that swing stiffly to and fro, each action at a tempo of its own: in integers and sums, so
// that what is tested is the motor alone.
Repertoire selfTestRepertoire() {
    Repertoire repertoire;
    repertoire.recordedLengthMetres = 0.25F;
    repertoire.response = {{0.6F, 0.5F, 0.4F}, 4.0F, 0.4F, 2.0F};
    for (std::size_t a = 0; a < kCapturedActions; ++a) {
        ActionSegment& segment = repertoire.segments[a];
        segment.periodSeconds = 0.5F + static_cast<float>(a) / 64;
        segment.playsToEnd = entriesOf(static_cast<Action>(a)) > 0;
        const float yaw = static_cast<float>(a % 5) / 1024 - 0.002F;
        for (std::size_t k = 0; k < kPhases; ++k) {
            segment.increments[k] = {glm::normalize(glm::quat(1, 0, yaw, yaw / 4)),
                                     {0.01F, 0.0F, 0.0F}};
            const int swing = 64 * (static_cast<int>(k < kPhases / 2 ? k : kPhases - k) - 16);
            for (std::size_t n = 0; n < body::kNodalPoints; ++n)
                segment.nodes[k][n] = {static_cast<std::int16_t>(-1000 * static_cast<int>(n)),
                                       0,
                                       static_cast<std::int16_t>(swing * static_cast<int>(n))};
        }
    }
    addGlide(repertoire);
    return repertoire;
}

}  // namespace

void MotorStep::runReference() const {
    assert(tables != nullptr);
    assert(commands != nullptr);
    assert(states != nullptr);
    assert(first <= last);
    assert(last <= states->size());
    assert(last <= traits.size());
    assert(last <= commands->action.size());
    const MotorColumns columns = columnsOf(*commands, *states);
    for (std::size_t fish = first; fish < last; ++fish) stepFish(*this, columns, fish);
    if (advection == nullptr) return;
    for (std::size_t fish = first; fish < last; ++fish) {
        states->x[fish] = moved(states->x[fish], advection->x[fish]);
        states->y[fish] = moved(states->y[fish], advection->y[fish]);
        states->z[fish] = moved(states->z[fish], advection->z[fish]);
    }
}

Quaternion swayOf(const MotorTables& tables, const MotionStates& states, std::size_t fish) {
    const auto swayIn = [&](std::uint16_t segment, std::uint16_t phase) {
        return swayAt(tables.segments[segment], phase);
    };
    const Quaternion played = swayIn(states.segment[fish], states.phase[fish]);
    if (states.warpFrame[fish] == states.warpLength[fish]) return played;
    const float share = static_cast<float>(states.warpFrame[fish] + 1) /
                        static_cast<float>(states.warpLength[fish] + 1);
    return lerp(swayIn(states.fromSegment[fish], states.fromPhase[fish]), played, share);
}

glm::quat meanRotation(const MotorTables& tables, const MotionStates& states, std::size_t fish) {
    assert(fish < states.size());
    const Quaternion mean =
        normalised(unpackedOrientation(states, fish) * swayOf(tables, states, fish));
    return {mean.w, mean.x, mean.y, mean.z};
}

glm::vec3 meanHeadingReference(const MotorTables& tables,
                               const MotionStates& states,
                               std::size_t fish) {
    const glm::quat m = meanRotation(tables, states, fish);
    return {1.0F - 2.0F * (m.y * m.y + m.z * m.z),
            2.0F * (m.x * m.y + m.w * m.z),
            2.0F * (m.x * m.z - m.w * m.y)};
}

std::uint64_t motorSelfTest() {
    constexpr std::size_t kFish = 100;  // not a whole number of vectors
    constexpr int kTicks = 120;
    const auto tables = makeMotorTables(selfTestRepertoire());
    MotionStates states;
    MotorCommands commands;
    states.resize(kFish);
    commands.resize(kFish);
    const std::vector<FishTraits> traits(kFish, FishTraits{.id = 0, .lengthMillimetres = 250});
    for (std::size_t fish = 0; fish < kFish; ++fish) setBodyFrame(states, fish, {});
    for (int tick = 0; tick < kTicks; ++tick) {
        for (std::size_t fish = static_cast<std::size_t>(tick) % 8; fish < kFish; fish += 8) {
            const auto action =
                static_cast<Action>((fish + static_cast<std::size_t>(tick)) % kActions);
            commands.action[fish] = static_cast<std::uint8_t>(action);
            commands.phaseRate[fish] = recordedPhaseRate(*tables, action);
            commands.pitch[fish] = static_cast<std::int16_t>(200 * fish);
            commands.yawRate[fish] = static_cast<std::int16_t>(tick);
            commands.brake[fish] = static_cast<std::uint8_t>(tick);
        }
        MotorStep{tables.get(), traits, &commands, &states, 0, kFish}.run();
    }
    return hashOf(states);
}

}  // namespace aquarama::motion
