// SPDX-License-Identifier: Apache-2.0
#include "capture/motor_controllers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace aquarama::capture {

namespace {

// Muscles.

// One contraction of a muscle group in a bend: it starts after `delay`, rises, holds and falls.
// Times are the fish's own seconds (Tissue::timeScale of them in one second) at a tempo of 1.
struct Pull {
    double delay, rise, hold, fall;
    double strength;  // activation where the strength of the bend is 1
};
// Found by a search over manoeuvres: with these values the heading changes by 35 to 70 degrees as
// the strength of the bend goes from 0.2 to 1.
constexpr Pull kFront{.delay = 0, .rise = 0.15, .hold = 0.5, .fall = 0.8, .strength = 0.10};
constexpr Pull kMiddle{.delay = 0, .rise = 0.15, .hold = 0.5, .fall = 0.8, .strength = 0.55};
constexpr Pull kBack{.delay = 0.04, .rise = 0.10, .hold = 0.40, .fall = 0.45, .strength = 1.0};
// The fins roll the fish for half of the bend, so that it is level again at its end.
constexpr Pull kBank{.delay = 0, .rise = 0.15, .hold = 0.3, .fall = 0.3, .strength = 1};

// 0 for t <= 0, 1 for t >= 1, with zero slope at both ends, so that the force has no kink.
double smoothStep(double t) {
    const double u = std::clamp(t, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

// The activation at a time since the order; `strength` is that of the bend, 0 to 1.
double pullAt(const Pull& pull, double strength, double ownSeconds) {
    const double since = ownSeconds - pull.delay;
    const double up = smoothStep(since / pull.rise);
    const double down = smoothStep((since - pull.rise - pull.hold) / pull.fall);
    return strength * pull.strength * up * (1 - down);
}

}  // namespace

MuscleActivation mix(const MuscleActivation& from, const MuscleActivation& to, double share) {
    assert(share >= 0);
    assert(share <= 1);
    return {.frontLeft = std::lerp(from.frontLeft, to.frontLeft, share),
            .frontRight = std::lerp(from.frontRight, to.frontRight, share),
            .middleLeft = std::lerp(from.middleLeft, to.middleLeft, share),
            .middleRight = std::lerp(from.middleRight, to.middleRight, share),
            .backLeft = std::lerp(from.backLeft, to.backLeft, share),
            .backRight = std::lerp(from.backRight, to.backRight, share)};
}

MuscleActivation mirrored(const MuscleActivation& muscles) {
    return {.frontLeft = muscles.frontRight,
            .frontRight = muscles.frontLeft,
            .middleLeft = muscles.middleRight,
            .middleRight = muscles.middleLeft,
            .backLeft = muscles.backRight,
            .backRight = muscles.backLeft};
}

// Straight on, left and right of a segment always add up to the drive: one side relaxes as the
// other contracts.
MuscleActivation beatAt(const config::Swim& swim, double gain, double beat, double curve) {
    assert(std::abs(curve) <= 1);
    const double phase = 2 * std::numbers::pi * beat;
    const double middle = (1 + std::sin(phase)) / 2;
    const double back = (1 + std::sin(phase - swim.backLagRadians)) / 2;
    const double middleDrive = swim.middleDrive * gain;
    const double backDrive = swim.backDrive * gain;
    return {.middleLeft = (1 + curve) * middleDrive * middle,
            .middleRight = (1 - curve) * middleDrive * (1 - middle),
            .backLeft = (1 + curve) * backDrive * back,
            .backRight = (1 - curve) * backDrive * (1 - back)};
}

MuscleActivation bendLeft(const config::Bend& bend, double ownSeconds) {
    const double own = ownSeconds * bend.tempo;
    return {.frontLeft = pullAt(kFront, bend.strength, own),
            .middleLeft = pullAt(kMiddle, bend.strength, own),
            .backLeft = pullAt(kBack, bend.strength, own)};
}

double bankShare(const config::Bend& bend, double ownSeconds) {
    return pullAt(kBank, 1, ownSeconds * bend.tempo);
}

MuscleActivation swim(const config::Species& species, const config::Gait& gait, double seconds) {
    const double ramp = std::min(1.0, seconds * species.tissue.timeScale / kRampOwnSeconds);
    return beatAt(species.swim, gait.gain * ramp, gait.beatHertz * seconds);
}

double secondsOf(const config::Bend& bend, const config::Species& species) {
    assert(bend.tempo > 0);
    constexpr double kOwnSeconds =
        std::max({kFront.delay + kFront.rise + kFront.hold + kFront.fall,
                  kMiddle.delay + kMiddle.rise + kMiddle.hold + kMiddle.fall,
                  kBack.delay + kBack.rise + kBack.hold + kBack.fall});
    return kOwnSeconds / (species.tissue.timeScale * bend.tempo);
}

namespace {

// Fast starts.

// Times are the fish's own seconds: in which the muscles of the beat before relax, the tissue
// stiffens, and relaxes after the stroke, and the beat with which it swims on grows.
constexpr double kRelaxed = 0.022, kStiffened = 0.009, kSoftened = 0.09, kBeats = 0.045;

// A contraction from one time to another.
double pulse(double t, double from, double to, const config::FastStart& start) {
    return smoothStep((t - from) / start.riseSeconds) *
           (1 - smoothStep((t - to) / start.fallSeconds));
}

// From 1 to a factor.
double mixed(double factor, double share) {
    return std::lerp(1.0, factor, share);
}

}  // namespace

double secondsOf(const config::FastStart& start, double bendShare) {
    return bendShare * start.bend.seconds + start.stroke.seconds;
}

double secondsUntilRelaxed(const config::Species& species, double bendShare) {
    return secondsOf(species.start, bendShare) + kSoftened / species.tissue.timeScale;
}

double startBeat(const config::Species& species, double bendShare, double seconds) {
    return species.start.beatPhase +
           (seconds - secondsOf(species.start, bendShare)) * species.swim.fast.beatHertz;
}

MotorControl startLeft(const config::Species& species,
                       double bendShare,
                       const MuscleActivation& before,
                       double seconds) {
    const config::FastStart& start = species.start;
    const double own = seconds * species.tissue.timeScale;
    const double bendEnd = bendShare * start.bend.seconds;
    const double end = secondsOf(start, bendShare);
    const double ownAfter = (seconds - end) * species.tissue.timeScale;
    const double old = 1 - smoothStep(own / kRelaxed);
    const config::Gait& fast = species.swim.fast;
    const MuscleActivation on = beatAt(species.swim,
                                       fast.gain * smoothStep(ownAfter / kBeats),
                                       startBeat(species, bendShare, seconds));
    const auto bend = [&](int segment) {
        const double lag = segment * start.lagSeconds;
        return pulse(seconds, lag, bendEnd + lag, start);
    };
    const auto stroke = [&](int segment) {
        const double lag = segment * start.lagSeconds;
        return pulse(seconds, bendEnd + lag, end + lag, start);
    };
    const auto most = [&](double then, double now, double pulled) {
        return std::max(then * old + now, pulled);
    };
    const double alert = smoothStep(own / kStiffened) * (1 - smoothStep(ownAfter / kSoftened));
    return {
        .muscles =
            {.frontLeft = most(before.frontLeft, on.frontLeft, start.bend.front * bend(0)),
             .frontRight = most(before.frontRight, on.frontRight, start.stroke.front * stroke(0)),
             .middleLeft = most(before.middleLeft, on.middleLeft, start.bend.middle * bend(1)),
             .middleRight =
                 most(before.middleRight, on.middleRight, start.stroke.middle * stroke(1)),
             .backLeft = most(before.backLeft, on.backLeft, start.bend.back * bend(2)),
             .backRight = most(before.backRight, on.backRight, start.stroke.back * stroke(2))},
        .fins = {},
        .rowing = {},
        .tone = {.stiffness = mixed(start.tone, alert),
                 .tailStiffness = mixed(start.tailTone, alert),
                 .contractStiffness = mixed(start.muscleTone, alert),
                 .contraction = mixed(start.contraction, alert)}};
}

namespace {

// Fins. Angles are FinPlate::angleRadians.

constexpr double kFlat = std::numbers::pi / 2;  // parallel to the flow: no force
constexpr double kAcross = std::numbers::pi;    // perpendicular to it: the most drag
// Tu's fins turn between a quarter of pi and pi.
constexpr double kLeastAngle = std::numbers::pi / 4;

// Fin angle by error of attitude, radians by radian.
constexpr double kPitchGain = 1.5;
constexpr double kRollGain = 1;
constexpr double kMostCorrection = 0.8;  // of each correction: radians of fin angle, or its share

double bounded(double correction) {
    return std::clamp(correction, -kMostCorrection, kMostCorrection);
}

// A plate at the angle or at the nearest that it can have.
FinPlate at(double angleRadians) {
    return {.angleRadians = std::clamp(angleRadians, kLeastAngle, kAcross)};
}

}  // namespace

FinPlates hold(const BodyAngles& attitude, double pitchRadians, double rollRadians) {
    const double lift = bounded(kPitchGain * (pitchRadians - attitude.pitchRadians));
    const double level = bounded(kRollGain * (attitude.rollRadians - rollRadians));
    return {.left = at(kFlat + lift + level), .right = at(kFlat + lift - level)};
}

FinPlates turnedAbout(const FinPlates& plates) {
    return {.left = at(2 * kFlat - plates.left.angleRadians),
            .right = at(2 * kFlat - plates.right.angleRadians)};
}

FinPlates lift(double radians) {
    return {.left = at(kFlat + radians), .right = at(kFlat + radians)};
}

FinPlates brake() {
    return {.left = at(kAcross), .right = at(kAcross)};
}

BladeMotion strokeAt(const config::Rowing& rowing,
                     const FinStroke& stroke,
                     double beatHertz,
                     double beat) {
    const double rate = 2 * std::numbers::pi * beatHertz;
    const double phase = 2 * std::numbers::pi * beat;
    const double travel = stroke.share * static_cast<double>(rowing.strokeRadians);
    const double feather = stroke.share * stroke.drive * static_cast<double>(rowing.featherRadians);
    const double twisted = phase + static_cast<double>(rowing.leadRadians);
    return {.pose = {stroke.openRadians,
                     static_cast<double>(rowing.middleRadians) + travel * std::sin(phase),
                     static_cast<double>(rowing.twistRadians) - stroke.drive * stroke.lift +
                         feather * std::cos(twisted)},
            .rate = {0, rate * travel * std::cos(phase), -rate * feather * std::sin(twisted)}};
}

}  // namespace aquarama::capture
