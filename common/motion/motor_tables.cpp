// SPDX-License-Identifier: Apache-2.0
#include "common/motion/motor_tables.h"

#include <algorithm>

#include "common/motion/warp_plan.h"
#include "common/units/ids.h"

namespace aquarama::motion {
namespace {

Quaternion narrow(const glm::dquat& q) {
    return {static_cast<float>(q.w),
            static_cast<float>(q.x),
            static_cast<float>(q.y),
            static_cast<float>(q.z)};
}

std::array<float, 3> narrow(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::int16_t phaseRateOf(const ActionSegment& segment) {
    const double rate = 65536.0 / (static_cast<double>(segment.periodSeconds) * kTicksPerSecond);
    return static_cast<std::int16_t>(std::clamp(roundToEven(rate), 1.0, 32767.0));
}

// atan by its series: one part in 10^9 for the turn of 1/64 cycle.
double angleOfHalfTurn(double tangent) {
    const double squared = tangent * tangent;
    return 2 * tangent * (1 - squared * (1.0 / 3 - squared * (1.0 / 5 - squared / 7)));
}

void measure(const GaitPath& path, double periodSeconds, SegmentTables& tables) {
    double forward = 0;
    double turn = 0;
    for (std::size_t k = 0; k < kPhases; ++k) {
        forward += path.mean[k].forward;
        turn += angleOfHalfTurn(path.mean[k].halfTurn.y);
    }
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
// U.
float squareLoss(float drag) {
    return drag / (kSpeedUnitsPerBodyLength * static_cast<float>(kTicksPerSecond));
}

// By the rate over 1 + rate, each tick, a braking fish comes as far as by exp(-rate) all the time.
SpeedLoss lossOf(const SpeedResponse& response) {
    const auto& [slow, medium, fast] = response.swimDrag;
    const bool followsAtOnce = slow + medium + fast <= 0.0F;
    SpeedLoss loss{.brake = response.brakeRate /
                            (static_cast<float>(kTicksPerSecond) + response.brakeRate)};
    const auto drag = [&](Action action) -> float& {
        return loss.drag[static_cast<std::size_t>(action)];
    };
    loss.drag.fill(followsAtOnce ? 1.0F : squareLoss(medium));
    if (!followsAtOnce) {
        drag(Action::ForwardSlow) = squareLoss(slow);
        drag(Action::ForwardFast) = squareLoss(fast);
    }
    drag(Action::Glide) = squareLoss(response.glideDrag);
    return loss;
}

void fill(const ActionSegment& segment, SegmentTables& tables) {
    const GaitPath path = pathOf(segment);
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

// A turn was entered at the mean speed of medium swimming, but its first phase has the speed that
// the body frame had within the beat. The fish goes over from the one to the other in the first
// cell, so that one that comes from medium swimming plays the turn as recorded.
void enterFromMedium(MotorTables& tables) {
    const SegmentTables& medium = tables.segments[static_cast<std::size_t>(Action::ForwardMedium)];
    const float speed = medium.path.front().translationAndSpeed[3] * medium.phaseRate;
    for (SegmentTables& segment : tables.segments)
        if (segment.playsToEnd)
            segment.path.front().translationAndSpeed[3] = speed / segment.phaseRate;
}

}  // namespace

std::shared_ptr<const MotorTables> makeMotorTables(const Repertoire& repertoire) {
    auto tables = std::make_shared<MotorTables>();
    std::array<std::int16_t, kActions> phaseRates{};
    for (std::size_t action = 0; action < kActions; ++action) {
        fill(repertoire.segments[action], tables->segments[action]);
        const SegmentTables& made = tables->segments[action];
        phaseRates[action] = made.phaseRate;
        tables->turnRate[action] = made.playsToEnd ? made.phaseRate : 0;
    }
    enterFromMedium(*tables);
    tables->loss = lossOf(repertoire.response);
    const WarpPlans plans = planWarps(repertoire, phaseRates);
    for (std::size_t action = 0; action < kActions; ++action) {
        tables->segments[action].warpTo = plans[action];
    }
    return tables;
}

std::int16_t recordedPhaseRate(const MotorTables& tables, Action action) {
    return tables.segments[static_cast<std::size_t>(action)].phaseRate;
}

float recordedSpeedBodyLengths(const MotorTables& tables, Action action) {
    return tables.segments[static_cast<std::size_t>(action)].speedBodyLengths;
}

float recordedTurnRate(const MotorTables& tables, Action action) {
    return tables.segments[static_cast<std::size_t>(action)].turnRate;
}

}  // namespace aquarama::motion
