// SPDX-License-Identifier: Apache-2.0
#include "common/motion/motor_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "common/base/units.h"

namespace aquarama::motion {
namespace {

constexpr std::size_t kCycle = kPhases;
constexpr double kNoWayBodyLengths = 1e-6;    // a path shorter than this has no direction
constexpr double kInPlaceBodyLengths = 1e-4;  // in a cycle: less is no way

// The body frame over two cycles, from the increments (eq. 6 and 7).
void integrate(const FrameIncrements& increments, GaitPath& path) {
    path.rotation[0] = glm::dquat(1, 0, 0, 0);
    for (std::size_t k = 0; k + 1 < kPathSamples; ++k) {
        const FrameIncrement& step = increments[k % kCycle];
        const glm::dquat turn(step.rotation);
        path.translation[k + 1] =
            path.translation[k] + path.rotation[k] * glm::dvec3(step.translation);
        // The nearer of the two quaternions of a rotation, so that the path may be interpolated.
        path.rotation[k + 1] = glm::normalize(path.rotation[k] * (turn.w < 0 ? turn * -1.0 : turn));
    }
}

// The path continued by a cycle before its first phase.
glm::dquat rotationAt(const GaitPath& path, int phase) {
    if (phase >= 0) return path.rotation[static_cast<std::size_t>(phase)];
    const int inCycle = phase + kPhases;
    return glm::conjugate(path.rotation[kCycle]) * path.rotation[static_cast<std::size_t>(inCycle)];
}

// The mean of the rotations within half a cycle of `phase`, the two outermost at half weight. A sum
// of quaternions, normalised: exact enough as they differ by a tail beat only.
glm::dquat meanAt(const GaitPath& path, int phase) {
    constexpr int kHalf = kPhases / 2;
    glm::dquat sum = (rotationAt(path, phase - kHalf) + rotationAt(path, phase + kHalf)) * 0.5;
    for (int near = phase - kHalf + 1; near < phase + kHalf; ++near) {
        sum = sum + rotationAt(path, near);
    }
    return glm::normalize(sum);
}

// The least rotation that turns the body's x axis into the direction `way`, of any length.
glm::dquat towards(const glm::dvec3& way) {
    if (way.x < kNoWayBodyLengths) return {1, 0, 0, 0};
    const double length = std::sqrt(glm::dot(way, way));
    return glm::normalize(glm::dquat(1 + way.x / length, 0, -way.z / length, way.y / length));
}

// The rotation along the path at phase k. The path's direction is taken over two phases to either
// side, or fewer near the ends.
glm::dquat alongPath(const GaitPath& path, std::size_t k) {
    const std::size_t reach = std::clamp<std::size_t>(std::min(k, kCycle - k), 1, 2);
    const std::size_t from = k < reach ? k : k - reach;
    const std::size_t to = std::min(k + reach, kCycle);
    return towards(glm::conjugate(path.rotation[k]) *
                   (path.translation[to] - path.translation[from]));
}

// From 1 at the border of a turn to 0 a quarter of it away, smoothly; k phases from the border.
double quarterShare(std::size_t k) {
    const double left = std::max(0.0, 1 - static_cast<double>(k) / (kPhases / 4.0));
    return left * left * (3 - 2 * left);
}

// The cycle-mean frame at each phase, as seen from phase 0.
using Means = std::array<glm::dquat, kCycleSamples>;

Means meansOfCycle(const GaitPath& path) {
    Means means{};
    for (std::size_t k = 0; k < kCycleSamples; ++k) means[k] = meanAt(path, static_cast<int>(k));
    return means;
}

// A turn is not a cycle and has no mean over one. Its mean frame looks along its path, from which
// the bent body deviates; over the last quarter it changes to the direction `after`, in which the
// fish swims on, and over the first quarter from `before` where the turn begins in a tail beat.
// Both in the body frame.
Means meansOfTurn(const GaitPath& path,
                  const std::optional<glm::dvec3>& before,
                  const glm::dvec3& after) {
    Means means{};
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        const double last = quarterShare(kCycle - k);
        const double first = before ? quarterShare(k) : 0;
        const glm::dquat mean = towards(before.value_or(after)) * first + towards(after) * last +
                                alongPath(path, k) * (1 - first - last);
        means[k] = path.rotation[k] * glm::normalize(mean);
    }
    return means;
}

// In a fast start the body turns faster than its path, which begins sideways. The mean frame turns
// evenly from the course before to that after, both in the body frame.
Means meansOfStart(const GaitPath& path, const glm::dvec3& before, const glm::dvec3& after) {
    const glm::dquat first = path.rotation[0] * towards(before);
    const glm::dquat last = path.rotation[kCycle] * towards(after);
    Means means{};
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        const double t = std::min(1.0, static_cast<double>(k) / kPhases);
        const double share = t * t * (3 - 2 * t);
        means[k] = glm::normalize(first * (1 - share) + last * share);
    }
    return means;
}

// Turns the mean frames of a cycle so that their x axis lies along the path, by one rotation for
// the whole cycle: the path's mean direction in the mean frame, or for a retreat its opposite.
void lookAlongPath(const GaitPath& path, Means& means) {
    glm::dvec3 way{};
    for (std::size_t k = 0; k < kCycle; ++k)
        way += glm::conjugate(means[k]) * (path.translation[k + 1] - path.translation[k]);
    const double length = std::sqrt(glm::dot(way, way));
    if (length < kInPlaceBodyLengths) return;
    way *= (way.x < 0 ? -1 : 1) / length;
    const glm::dquat turn = glm::normalize(glm::dquat(1 + way.x, 0, -way.z, way.y));
    for (glm::dquat& mean : means) mean = glm::normalize(mean * turn);
}

// Body lengths along the mean frame's x axis in 1/64 of a cycle at phase k: a central difference,
// taken in the second cycle, which has a first before it. Where a turn begins or ends, the
// difference is one-sided.
double forwardAt(const GaitPath& path, std::size_t k, bool playsToEnd) {
    const std::size_t at = kCycle + k % kCycle;
    const bool begins = playsToEnd && k == 0;
    const bool ends = playsToEnd && k == kCycle;
    const glm::dvec3 before = path.translation[begins ? at : at - 1];
    const glm::dvec3 after = path.translation[ends ? at : at + 1];
    const glm::dvec3 step = (after - before) * (begins || ends ? 1.0 : 0.5);
    const glm::dvec3 inBody = glm::conjugate(path.rotation[at]) * step;
    return (glm::conjugate(path.bodyFromMean[k]) * inBody).x;
}

void setMeans(const Means& means, bool playsToEnd, GaitPath& path) {
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        path.bodyFromMean[k] = glm::conjugate(path.rotation[k]) * means[k];
    }
    double way = 0;
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        const std::size_t now = k % kCycle;
        const glm::dquat turn = glm::conjugate(means[now]) * means[now + 1];
        path.mean[k] = {glm::dvec3(turn.x, turn.y, turn.z) / turn.w,
                        forwardAt(path, k, playsToEnd)};
        if (k < kCycle) way += path.mean[k].forward;
    }
    // A cycle in one place has no speed, not even that of its rounding errors.
    if (!playsToEnd && std::abs(way) < kInPlaceBodyLengths)
        for (auto& mean : path.mean) mean.forward = 0;
}

// Converts to floats, after all arithmetic.
Quaternion narrow(const glm::dquat& q) {
    return {static_cast<float>(q.w),
            static_cast<float>(q.x),
            static_cast<float>(q.y),
            static_cast<float>(q.z)};
}

std::array<float, 3> narrow(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// 1/65536 of a cycle in a tick: a recorded fish plays its cycle in its period.
std::int16_t phaseRateOf(const ActionSegment& segment) {
    const double rate = 65536.0 / (static_cast<double>(segment.periodSeconds) * kTicksPerSecond);
    return static_cast<std::int16_t>(std::clamp(roundToEven(rate), 1.0, 32767.0));
}

// Twice the arc tangent, by its series: one part in 10^9 for the turn of 1/64 cycle.
double angleOfHalfTurn(double tangent) {
    const double squared = tangent * tangent;
    return 2 * tangent * (1 - squared * (1.0 / 3 - squared * (1.0 / 5 - squared / 7)));
}

// Means over the cycle: speed, and rate of turn about the mean frame's y axis; and half the turn.
void measure(const GaitPath& path, double periodSeconds, SegmentTables& tables) {
    double forward = 0;
    double turn = 0;
    glm::dvec3 halfTurn{};
    for (std::size_t k = 0; k < kPhases; ++k) {
        forward += path.mean[k].forward;
        turn += angleOfHalfTurn(path.mean[k].halfTurn.y);
        halfTurn += path.mean[k].halfTurn;
    }
    if (!tables.playsToEnd) tables.meanHalfTurn = narrow(halfTurn / 65536.0);
    tables.speedBodyLengths = static_cast<float>(forward / periodSeconds);
    tables.turnRate = static_cast<float>(turn / periodSeconds);
}

// Speed units for each unit of phase rate, 1/65536 of a cycle in a tick: of a turn at phase k, of a
// cycle its mean.
float speedOf(const GaitPath& path, std::size_t k, bool playsToEnd) {
    double forward = path.mean[std::min(k, kCycleSamples - 1)].forward;
    if (!playsToEnd) {
        forward = 0;
        for (std::size_t phase = 0; phase < kPhases; ++phase) forward += path.mean[phase].forward;
        forward /= kPhases;
    }
    constexpr double kUnitsPerCellInTick =
        static_cast<double>(kSpeedUnitsPerBodyLength) * kTicksPerSecond;
    return static_cast<float>(forward * kUnitsPerCellInTick / 1024);
}

// dv = drag v^2 dt, in units u of which there are U to a body length a second: du = drag u^2 dt /
// U. dt is a tick.
float squareLoss(float drag) {
    return drag / (kSpeedUnitsPerBodyLength * static_cast<float>(kTicksPerSecond));
}

// 1 / body length, of an action that swims or turns.
float swimDragOf(const SpeedResponse& response,
                 const std::array<SegmentTables, kSegments>& segments,
                 std::uint32_t segment) {
    const Action action = actionOf(segment);
    const std::size_t gait = indexOf(gaitOf(action));
    const float drag = response.swimDrag[gait];
    if (!swims(action)) return drag;
    const float slower = segments[gait].speedBodyLengths / segments[segment].speedBodyLengths;
    return drag * slower * slower;
}

// With a loss of rate / (ticks a second + rate) in each tick, a braking fish travels as far as with
// the continuous exp(-rate t).
SpeedLoss lossOf(const SpeedResponse& response,
                 const std::array<SegmentTables, kSegments>& segments) {
    const auto& [slow, medium, fast] = response.swimDrag;
    SpeedLoss loss{.brake = response.brakeRate /
                            (static_cast<float>(kTicksPerSecond) + response.brakeRate)};
    loss.drag.fill(1.0F);
    if (slow + medium + fast > 0.0F) {
        for (std::uint32_t segment = 0; segment < kSegments; ++segment)
            loss.drag[segment] = squareLoss(swimDragOf(response, segments, segment));
        loss.drag[firstSegmentOf(Action::Retreat)] = squareLoss(response.retreatDrag);
    }
    loss.drag[firstSegmentOf(Action::Glide)] = squareLoss(response.glideDrag);
    return loss;
}

// Whether a pectoral fin changes its stroke within a segment.
bool rowsIn(const ActionSegment& segment) {
    const auto stroke = [](const FinAnglePair& fins) { return fins[0][1]; };
    const auto [least, most] = std::ranges::minmax(segment.fins, {}, stroke);
    constexpr float kStill = 0.1F;  // radians
    return static_cast<float>(stroke(most) - stroke(least)) * kFinUnit > kStill;
}

// The tables of one segment, whose path is given.
void fill(const ActionSegment& segment, const GaitPath& path, SegmentTables& tables) {
    tables.phaseRate = phaseRateOf(segment);
    tables.playsToEnd = segment.playsToEnd;
    measure(path, static_cast<double>(segment.periodSeconds), tables);
    for (std::size_t k = 0; k < kPathSamples; ++k) {
        const auto [x, y, z] = narrow(path.translation[k]);
        const float speed = speedOf(path, k, segment.playsToEnd);
        tables.path[k] = {narrow(path.rotation[k]), {x, y, z, speed}};
    }
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        tables.bodyFromMean[k] = narrow(path.bodyFromMean[k]);
    }
    if (segment.playsToEnd) return;
    // The mean frame repeats with the cycle to rounding; here it does so to the bit.
    tables.bodyFromMean.back() = tables.bodyFromMean.front();
}

// A turn out of a glide was recorded out of medium swimming, at its mean speed; but the first phase
// of the recording has the speed that the body frame had within the beat. The first sample is
// therefore given the mean speed, and the table interpolates over the first cell.
void enterFromMedium(const SegmentTables& medium, SegmentTables& turn) {
    const float speed =
        medium.path.front().translationAndSpeed[3] * static_cast<float>(medium.phaseRate);
    turn.path.front().translationAndSpeed[3] = speed / static_cast<float>(turn.phaseRate);
}

// The tables of a turn or a fast start by entry, from `entered` on.
void fillEntries(const ActionSegment& turn,
                 bool isStart,
                 std::int32_t lastPhase,
                 SegmentTables* entered) {
    for (const TurnPath& path : turn.entered) {
        SegmentTables& tables = *entered++;
        fill(turn, pathOf(path, turn.periodSeconds, isStart), tables);
        tables.lastPhase = lastPhase;
    }
}

// All segments of a turn or a fast start.
void fillToEnd(const ActionSegment& segment, Action action, MotorTables& tables) {
    SegmentTables* const first = &tables.segments[firstSegmentOf(action)];
    fill(segment, pathOf(segment), *first);
    if (isStart(action)) {
        first->lastPhase = lastPhaseOf(action);
    } else {
        enterFromMedium(tables.segments[indexOf(Action::ForwardMedium)], *first);
    }
    const int segments = isStart(action) ? kStartSegments : kTurnSegments;
    std::fill(first + 1, first + segments, *first);
    fillEntries(segment, isStart(action), first->lastPhase, isStart(action) ? first : first + 1);
}

// Borders half-way between the speeds at which a turn was entered. Where the speeds do not rise, no
// fish reaches the border.
void setBorders(std::span<const TurnPath> entered, std::span<std::int32_t> borders) {
    if (entered.empty()) return;
    for (std::size_t border = 0; border < borders.size(); ++border) {
        const auto speedOfEntry = [&](std::size_t speed) {
            return static_cast<double>(entered[speed * kEntryPhases].speedBefore);
        };
        const double between = 0.5 * (speedOfEntry(border) + speedOfEntry(border + 1));
        borders[border] = static_cast<std::int32_t>(
            roundToEven(between * static_cast<double>(kSpeedUnitsPerBodyLength)));
    }
}

}  // namespace

GaitPath pathOf(const ActionSegment& segment) {
    GaitPath path;
    integrate(segment.increments, path);
    Means means{};
    if (segment.playsToEnd) {
        means = meansOfTurn(path, std::nullopt, {1, 0, 0});
    } else {
        means = meansOfCycle(path);
        lookAlongPath(path, means);
    }
    setMeans(means, segment.playsToEnd, path);
    return path;
}

GaitPath pathOf(const TurnPath& turn, float periodSeconds, bool isStart) {
    GaitPath path;
    integrate(turn.increments, path);
    const glm::dvec3 from(turn.courseBefore), to(turn.courseAfter);
    setMeans(isStart ? meansOfStart(path, from, to) : meansOfTurn(path, from, to), true, path);
    // The body frame's speed at either end is that within a beat: instead the fish has its mean
    // speed before the turn, and that with which it swims on after it.
    const double unit = static_cast<double>(periodSeconds) / kPhases;
    const double before = static_cast<double>(turn.speedBefore) * unit - path.mean[0].forward;
    const double after = static_cast<double>(turn.speedAfter) * unit - path.mean[kCycle].forward;
    for (std::size_t k = 0; k < kCycleSamples; ++k)
        path.mean[k].forward += before * quarterShare(k) + after * quarterShare(kCycle - k);
    return path;
}

namespace {

PointPairs pairsOf(const NodalPose& pose, const NodalPose& next) {
    PointPairs pairs;
    for (std::size_t group = 0; group < pairs.groups.size(); ++group)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < kPointGroup; ++i) {
                const std::size_t point = group * kSecondGroup + i;
                const auto low = static_cast<std::uint16_t>(pose[point][axis]);
                const auto high = static_cast<std::uint16_t>(next[point][axis]);
                pairs.groups[group][axis][i] =
                    static_cast<std::int32_t>(std::uint32_t{high} << 16U | low);
            }
    return pairs;
}

// See MotorTables::facts.
std::int32_t factsOf(const MotorTables& tables, std::uint32_t segment) {
    const SegmentTables& made = tables.segments[segment];
    const auto action = static_cast<std::int32_t>(actionOf(segment));
    const std::int32_t turnRate = made.playsToEnd ? made.phaseRate : 0;
    return action | (tables.pitchRate[segment] != 0.0F ? kPitchesInAddition : 0) |
           turnRate << kTurnRateBit;
}

}  // namespace

std::shared_ptr<const MotorTables> makeMotorTables(const Repertoire& repertoire,
                                                   const KeepWarpPlans& keep) {
    auto tables = std::make_shared<MotorTables>();
    std::array<std::int16_t, kActions> phaseRates{};
    for (std::size_t i = 0; i < kActions; ++i) {
        const ActionSegment& segment = repertoire.segments[i];
        const auto action = static_cast<Action>(i);
        const std::size_t first = firstSegmentOf(action);
        if (segment.playsToEnd)
            fillToEnd(segment, action, *tables);
        else
            fill(segment, pathOf(segment), tables->segments[first]);
        phaseRates[i] = tables->segments[first].phaseRate;
        tables->rows[i] = rowsIn(segment);
        for (std::size_t k = 0; k < kPhases; ++k)
            tables->poses[i][k] = pairsOf(segment.nodes[k], segment.nodes[(k + 1) % kPhases]);
    }
    setBorders(repertoire.segments[kFirstTurn].entered, tables->turnBorders);
    const std::span starts(repertoire.segments[kFirstStart].entered);
    setBorders(starts.empty() ? starts : starts.subspan(1), tables->startBorders);
    const SegmentTables& climb = tables->segments[indexOf(Action::ClimbMedium)];
    // Slopes and pitching in place are captured: beside them the fins only trim.
    const float pitchRate = 2.0F * climb.meanHalfTurn[2] * static_cast<float>(climb.phaseRate);
    for (std::uint32_t segment = 0; segment < kSegments; ++segment)
        tables->pitchRate[segment] = !pitches(actionOf(segment)) && !staysInPlace(actionOf(segment))
                                         ? kAddedPitch * pitchRate
                                         : 0.0F;
    for (std::uint32_t segment = 0; segment < kSegments; ++segment)
        tables->facts[segment] = factsOf(*tables, segment);
    tables->loss = lossOf(repertoire.response, tables->segments);
    const auto make = [&] { return planWarps(repertoire, phaseRates); };
    tables->warps = keep ? keep(make) : make();
    return tables;
}

std::int16_t recordedPhaseRate(const MotorTables& tables, Action action) {
    return tables.segments[firstSegmentOf(action)].phaseRate;
}

float recordedSpeedBodyLengths(const MotorTables& tables, Action action) {
    return tables.segments[firstSegmentOf(action)].speedBodyLengths;
}

float recordedPitchRate(const MotorTables& tables, Action action) {
    const SegmentTables& segment = tables.segments[firstSegmentOf(action)];
    return 2.0F * segment.meanHalfTurn[2] * static_cast<float>(segment.phaseRate) *
           static_cast<float>(kTicksPerSecond);
}

float recordedTurnRate(const MotorTables& tables, std::uint32_t segment) {
    return tables.segments[segment].turnRate;
}

}  // namespace aquarama::motion
