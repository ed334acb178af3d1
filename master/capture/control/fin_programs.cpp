// SPDX-License-Identifier: Apache-2.0
#include "master/capture/control/fin_programs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aquarama::capture {

namespace {

constexpr double kFlat = std::numbers::pi / 2;
constexpr double kAcross = std::numbers::pi;
// Tu's fins turn between a quarter of pi and pi.
constexpr double kLeastAngle = std::numbers::pi / 4;

constexpr double kPitchGain = 1.5;
constexpr double kRollGain = 1;
constexpr double kMostCorrection = 0.8;  // radians, of each

// A fin of a fifth of a body length that sweeps through 90 degrees moves its middle so far.
constexpr double kStrokeBodyLengths = 0.15;
constexpr double kHeadingGain = 2;  // share of the stroke by radian

double bounded(double correction) {
    return std::clamp(correction, -kMostCorrection, kMostCorrection);
}

PectoralFin at(double angleRadians) {
    return {.angleRadians = std::clamp(angleRadians, kLeastAngle, kAcross)};
}

}  // namespace

PectoralFins hold(const BodyAngles& attitude, double pitchRadians) {
    const double lift = bounded(kPitchGain * (pitchRadians - attitude.pitchRadians));
    const double level = bounded(kRollGain * attitude.rollRadians);
    return {.left = at(kFlat + lift + level), .right = at(kFlat + lift - level)};
}

PectoralFins brake() {
    return {.left = at(kAcross), .right = at(kAcross)};
}

PectoralFins row(const config::Gait& gait,
                 double stroke,
                 const BodyAngles& attitude,
                 double headingRadians) {
    const double speed = std::numbers::pi * kStrokeBodyLengths * gait.gain * gait.beatHertz *
                         std::sin(2 * std::numbers::pi * stroke);
    const bool isPower = speed > 0;
    // The water comes from behind, so that the corrections of a fish that moves forward change
    // sign.
    PectoralFins fins = isPower ? brake()
                                : hold({.headingRadians = 0,
                                        .pitchRadians = -attitude.pitchRadians,
                                        .rollRadians = -attitude.rollRadians},
                                       0);
    const double lack =
        bounded(kHeadingGain *
                std::remainder(headingRadians - attitude.headingRadians, 2 * std::numbers::pi));
    fins.left.sweepSpeed = speed * (isPower ? 1 + lack : 1);
    fins.right.sweepSpeed = speed * (isPower ? 1 - lack : 1);
    return fins;
}

}  // namespace aquarama::capture
