// SPDX-License-Identifier: Apache-2.0
#include "master/capture/control/muscle_programs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aquarama {

namespace {

// Of the fish's own seconds (Tissue::timeScale of them in one of ours).
struct Pull {
    double delay, rise, hold, fall;
    double strength;  // activation at a bend of 1
};
// Found by a search over manoeuvres: with these the heading changes by 35 to 70 degrees as the bend
// goes from 0.2 to 1.
constexpr Pull kFront{.delay = 0, .rise = 0.15, .hold = 0.5, .fall = 0.8, .strength = 0.10};
constexpr Pull kMiddle{.delay = 0, .rise = 0.15, .hold = 0.5, .fall = 0.8, .strength = 0.55};
constexpr Pull kBack{.delay = 0.04, .rise = 0.10, .hold = 0.40, .fall = 0.45, .strength = 1.0};
constexpr double kSwimFade = 0.04;
constexpr double kRamp = 1.0;

double smoothStep(double t) {
    const double u = std::clamp(t, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

double pullAt(const Pull& pull, double strength, double ownSeconds) {
    const double since = ownSeconds - pull.delay;
    const double up = smoothStep(since / pull.rise);
    const double down = smoothStep((since - pull.rise - pull.hold) / pull.fall);
    return strength * pull.strength * up * (1 - down);
}

MuscleActivation scaled(const MuscleActivation& muscles, double by) {
    return {.frontLeft = muscles.frontLeft * by,
            .frontRight = muscles.frontRight * by,
            .middleLeft = muscles.middleLeft * by,
            .middleRight = muscles.middleRight * by,
            .backLeft = muscles.backLeft * by,
            .backRight = muscles.backRight * by};
}

}  // namespace

MuscleActivation swim(const Species& species, const Gait& gait, double seconds) {
    const double ramp = std::min(1.0, seconds * species.tissue.timeScale / kRamp);
    const double beat = 2 * std::numbers::pi * gait.beatHertz * seconds;
    const double middle = (1 + std::sin(beat)) / 2;
    const double back = (1 + std::sin(beat - species.swim.backLagRadians)) / 2;
    const double middleDrive = species.swim.middleDrive * gait.gain * ramp;
    const double backDrive = species.swim.backDrive * gait.gain * ramp;
    return {.middleLeft = middleDrive * middle,
            .middleRight = middleDrive * (1 - middle),
            .backLeft = backDrive * back,
            .backRight = backDrive * (1 - back)};
}

MuscleActivation turnLeft(const Species& species, const Bend& bend, double onset, double seconds) {
    const double own = (seconds - onset) * species.tissue.timeScale * bend.tempo;
    const double swimming = std::clamp(1 - own / kSwimFade, 0.0, 1.0);
    MuscleActivation muscles = scaled(swim(species, species.swim.medium, seconds), swimming);
    muscles.frontLeft = std::max(muscles.frontLeft, pullAt(kFront, bend.strength, own));
    muscles.middleLeft = std::max(muscles.middleLeft, pullAt(kMiddle, bend.strength, own));
    muscles.backLeft = std::max(muscles.backLeft, pullAt(kBack, bend.strength, own));
    return muscles;
}

double secondsOf(const Bend& bend, const Species& species) {
    constexpr double kOwnSeconds =
        std::max({kFront.delay + kFront.rise + kFront.hold + kFront.fall,
                  kMiddle.delay + kMiddle.rise + kMiddle.hold + kMiddle.fall,
                  kBack.delay + kBack.rise + kBack.hold + kBack.fall});
    return kOwnSeconds / (species.tissue.timeScale * bend.tempo);
}

}  // namespace aquarama
