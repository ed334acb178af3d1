// SPDX-License-Identifier: Apache-2.0
#include "common/motion/motor_tables.h"

#include <algorithm>

#include "common/motion/warp_plan.h"
#include "common/units/ids.h"
#include "common/units/quantity.h"

namespace aquarama {
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

std::uint16_t phaseRateOf(const ActionSegment& segment) {
    const double rate = 65536.0 / (static_cast<double>(segment.periodSeconds) * kTicksPerSecond);
    return static_cast<std::uint16_t>(std::clamp(roundToEven(rate), 1.0, 65535.0));
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

GlideSample glideOf(const GaitPath& path, std::size_t k, double cellsPerTick, bool playsToEnd) {
    const MeanMotion& mean = path.mean[k];
    // A turn that plays to its end is entered and left on a straight course.
    const glm::dvec3 halfTurn = playsToEnd ? glm::dvec3(0) : mean.halfTurn * cellsPerTick;
    return {narrow(path.bodyFromMean[k]),
            narrow(halfTurn),
            static_cast<float>(mean.forward * cellsPerTick)};
}

void fill(const ActionSegment& segment, SegmentTables& tables) {
    const GaitPath path = pathOf(segment);
    tables.phaseRate = phaseRateOf(segment);
    tables.inversePhaseRate = 1.0F / static_cast<float>(tables.phaseRate);
    tables.playsToEnd = segment.playsToEnd;
    measure(path, static_cast<double>(segment.periodSeconds), tables);
    for (std::size_t k = 0; k < kPathSamples; ++k) {
        const auto [x, y, z] = narrow(path.translation[k]);
        tables.path[k] = {narrow(path.rotation[k]), {x, y, z, 0.0F}};
    }
    const double cellsPerTick = static_cast<double>(tables.phaseRate) / 1024.0;
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        tables.bodyFromMean[k] = narrow(path.bodyFromMean[k]);
        tables.glide[k] = glideOf(path, k, cellsPerTick, segment.playsToEnd);
    }
    if (segment.playsToEnd) return;
    // The mean frame repeats with the cycle to rounding; here it does so to the bit.
    tables.bodyFromMean.back() = tables.bodyFromMean.front();
    tables.glide.back() = tables.glide.front();
}

}  // namespace

std::shared_ptr<const MotorTables> makeMotorTables(const Repertoire& repertoire) {
    auto tables = std::make_shared<MotorTables>();
    std::array<std::uint16_t, kActions> phaseRates{};
    for (std::size_t action = 0; action < kActions; ++action) {
        fill(repertoire.segments[action], tables->segments[action]);
        phaseRates[action] = tables->segments[action].phaseRate;
    }
    const WarpPlans plans = planWarps(repertoire, phaseRates);
    for (std::size_t action = 0; action < kActions; ++action) {
        tables->segments[action].warpTo = plans[action];
    }
    return tables;
}

std::uint16_t recordedPhaseRate(const MotorTables& tables, Action action) {
    return tables.segments[static_cast<std::size_t>(action)].phaseRate;
}

float recordedSpeedBodyLengths(const MotorTables& tables, Action action) {
    return tables.segments[static_cast<std::size_t>(action)].speedBodyLengths;
}

float recordedTurnRate(const MotorTables& tables, Action action) {
    return tables.segments[static_cast<std::size_t>(action)].turnRate;
}

}  // namespace aquarama
