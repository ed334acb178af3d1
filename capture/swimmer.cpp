// SPDX-License-Identifier: Apache-2.0
#include "capture/swimmer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "capture/dynamics.h"
#include "capture/motor_controllers.h"

namespace aquarama::capture {

namespace {

// Linear, the short way round the circle.
double mixAngles(double from, double to, double share) {
    return from + share * std::remainder(to - from, 2 * std::numbers::pi);
}

}  // namespace

// Body x is the nose's direction. Left is -z, so the heading is positive there. The roll compares
// the heights of the z and the y axis; it is defined unless the fish stands on its nose or tail.
BodyAngles bodyAnglesOf(const FishState& state) {
    const glm::dmat3 worldFromBody = frameOf(state.positions).worldFromBody;
    const glm::dvec3& x = worldFromBody[0];
    return {.headingRadians = std::atan2(-x.z, x.x),
            .pitchRadians = std::asin(std::clamp(x.y, -1.0, 1.0)),
            .rollRadians = std::atan2(worldFromBody[2].y, worldFromBody[1].y)};
}

BodyAngles sense(const BodyAngles& before,
                 const FishState& state,
                 double share,
                 double stepSeconds) {
    assert(stepSeconds > 0);
    assert(share >= 0);
    assert(share <= 1);
    const BodyAngles now = bodyAnglesOf(state);
    return {.headingRadians = mixAngles(before.headingRadians, now.headingRadians, share),
            .pitchRadians = std::lerp(before.pitchRadians, now.pitchRadians, share),
            .rollRadians = now.rollRadians,
            .pitchRate = share * (now.pitchRadians - before.pitchRadians) / stepSeconds};
}

namespace {

// The tail beat fades out over this many beats. If it stopped at once, the fish would keep the yaw
// that the unfinished beat gave it.
constexpr double kLastBeats = 0.5;

// The change-over from one order's muscle activations to the next one's, in the fish's own seconds.
// A jump would kick the body.
constexpr double kHandover = 0.04;

// The fins act on the pitch that the fish will have so much later: a body that pitches goes on to,
// and without a lead it overshot a commanded slope by 70 %. Times of the low pass, a beat each.
constexpr double kPitchLeadBeats = 2;

// In so many of the fish's own seconds fins open and come to their full stroke.
constexpr double kOpenOwnSeconds = 0.2;
// Of a curve, by which the inner fin rows less.
constexpr double kInnerFin = 2.5;
// With it rowing fins pitch a fish up in its place.
constexpr double kPitchingLift = std::numbers::pi / 4;

// A fish that rows keeps the height at which it got the order: its fins twist against how much
// higher it is, and against its rise, both sensed as its attitude is. Radians by body lengths, by
// body lengths in the fish's own second, and at most.
constexpr double kHeightGain = 8;
constexpr double kRiseGain = 4;
constexpr double kMostLevelling = 0.6;

// Body lengths in the fish's own second. Below it, the water that passes the plates is too slow for
// them to hold the pitch.
constexpr double kGripSpeed = 0.3;

// Whether a controller rows with the fins alone.
bool onlyRows(Controller controller) {
    return controller == Controller::Hover || controller == Controller::LeftPivot ||
           controller == Controller::PitchUp || controller == Controller::Retreat;
}

}  // namespace

Swimmer::Swimmer(const BiomechanicalFish& fish, const config::Species& species, double stepSeconds)
    : fish_(fish), species_(species), stepSeconds_(stepSeconds), state_(stateAtRest(fish_)) {
    assert(stepSeconds > 0);
}

Swimmer::Swimmer(const config::Species& species, double stepSeconds)
    : Swimmer(makeBiomechanicalFish(species), species, stepSeconds) {}

Swimmer::Swimmer(const config::Species& species)
    : Swimmer(species, longestStepSeconds(makeBiomechanicalFish(species))) {}

void Swimmer::give(const Order& order) {
    assert(order.bend.tempo > 0);
    // After an order without a tail beat no beat is left that the next could fade out.
    fading_ = swims() ? beating_ : config::Gait{.gain = 0};
    if (starts()) {
        // It swims on with the beat of the start, which is grown.
        const double seconds = ownSecondsOfOrder_ / fish_.timeScale;
        beat_ = startBeat(species_, order_.bendShare, seconds);
        if (order_.controller == Controller::RightStart) beat_ += 0.5;
        beat_ -= std::floor(beat_);
        ownSecondsSwum_ = std::max(ownSecondsSwum_, kRampOwnSeconds);
    }
    order_ = order;
    if (swims() || onlyRows(order.controller)) beating_ = order.gait;
    ownSecondsOfOrder_ = 0;
    musclesBefore_ = control_.muscles;
    heightOfOrder_ = height_;
}

void Swimmer::advance(int steps) {
    assert(steps >= 0);
    for (int i = 0; i < steps; ++i) advanceOne();
}

// The clocks of the controllers stand at the middle of the step while the dynamics move, as the
// midpoint rule asks. The attitude is that sensed after the step before.
void Swimmer::advanceOne() {
    advanceClocks(stepSeconds_ / 2);
    control_ = program();
    step(fish_, control_, stepSeconds_, state_);
    ++steps_;
    // The low pass has a time constant of one beat, or of the fish's own second if that is shorter.
    const double hertz = std::max(beating_.beatHertz, fish_.timeScale);
    attitude_ = sense(attitude_, state_, stepSeconds_ * hertz, stepSeconds_);
    const double before = height_;
    height_ = std::lerp(height_, meanOf(fish_, state_.positions).y, stepSeconds_ * hertz);
    rise_ = (height_ - before) / stepSeconds_;
    advanceClocks(stepSeconds_ / 2);
}

std::array<glm::dvec3, 2> Swimmer::fins() const {
    if (control_.rowing.rows) return {control_.rowing.left.pose, control_.rowing.right.pose};
    const auto trimmed = [&](const FinPlate& fin) {
        return glm::dvec3(fish_.blade.folded, 0, fin.angleRadians - std::numbers::pi / 2);
    };
    return {trimmed(control_.fins.left), trimmed(control_.fins.right)};
}

bool Swimmer::rows() const {
    if (!species_.finMotion.rowing.rows()) return false;
    return onlyRows(order_.controller) || (swims() && beating_.rows > 0);
}

// Both fins row alike, ahead or back; on a curve the inner one less, and in a pivot against the
// other. Under a new order the fins open and the strokes grow.
RowingControl Swimmer::rowingProgram() const {
    double left = 1;
    double right = 1;
    switch (order_.controller) {
        case Controller::Hover:
            left = right = 0;
            break;
        case Controller::LeftPivot:
            left = -1;
            break;
        case Controller::Retreat:
            left = right = -1;
            break;
        default:
            left = 1 - kInnerFin * order_.curve;
            break;
    }
    const double grown = std::min(1.0, ownSecondsOfOrder_ / kOpenOwnSeconds);
    const double share = grown * (onlyRows(order_.controller) ? 1 : beating_.rows);
    const double down =
        kHeightGain * (height_ - heightOfOrder_) + kRiseGain * rise_ / fish_.timeScale;
    const double twist = lift() != 0 ? lift() : -std::clamp(down, -kMostLevelling, kMostLevelling);
    const auto at = [&](double drive) {
        return strokeAt(species_.finMotion.rowing,
                        {.drive = drive,
                         .lift = twist,
                         .share = share,
                         .openRadians = std::lerp(fish_.blade.folded, fish_.blade.rowing, grown)},
                        beating_.beatHertz,
                        beat_);
    };
    return {.rows = true, .left = at(left), .right = at(right)};
}

MotorControl Swimmer::program() const {
    const double seconds = ownSecondsOfOrder_ / fish_.timeScale;
    if (order_.controller == Controller::LeftStart)
        return startLeft(species_, order_.bendShare, musclesBefore_, seconds);
    if (order_.controller == Controller::RightStart) {
        MotorControl control =
            startLeft(species_, order_.bendShare, mirrored(musclesBefore_), seconds);
        control.muscles = mirrored(control.muscles);
        return control;
    }
    const double handedOver = std::min(1.0, ownSecondsOfOrder_ / kHandover);
    const bool rowing = rows();
    return {.muscles = mix(musclesBefore_, muscleProgram(), handedOver),
            .fins = finProgram(),
            .rowing = rowing ? rowingProgram() : RowingControl{},
            .rightsItself = rowing ? lift() == 0 : balancesWithoutGrip(),
            .tone = {}};
}

void Swimmer::advanceClocks(double seconds) {
    const double ownSeconds = seconds * fish_.timeScale;
    ownSecondsOfOrder_ += ownSeconds;
    if (swims()) ownSecondsSwum_ += ownSeconds;
    beat_ += seconds * beating_.beatHertz;
    beat_ -= std::floor(beat_);
}

bool Swimmer::starts() const {
    return order_.controller == Controller::LeftStart ||
           order_.controller == Controller::RightStart;
}

bool Swimmer::swims() const {
    return order_.controller == Controller::ForwardSwim ||
           order_.controller == Controller::Ascend || order_.controller == Controller::Descend ||
           order_.controller == Controller::Balance;
}

MuscleActivation Swimmer::muscleProgram() const {
    switch (order_.controller) {
        case Controller::ForwardSwim:
        case Controller::Ascend:
        case Controller::Descend:
        case Controller::Balance:
            if (beating_.gain != 0) return tailBeat(beating_.gain);
            break;
        case Controller::LeftTurn:
            return bendLeft(order_.bend, ownSecondsOfOrder_);
        case Controller::RightTurn:
            return mirrored(bendLeft(order_.bend, ownSecondsOfOrder_));
        default:
            break;
    }
    const double beatsOfOrder = ownSecondsOfOrder_ / fish_.timeScale * fading_.beatHertz;
    return tailBeat(fading_.gain * std::max(0.0, 1 - beatsOfOrder / kLastBeats));
}

// From rest the beat grows over kRampOwnSeconds.
MuscleActivation Swimmer::tailBeat(double gain) const {
    const double grown = std::min(1.0, ownSecondsSwum_ / kRampOwnSeconds);
    const double curve = order_.controller == Controller::ForwardSwim ? order_.curve : 0;
    return beatAt(species_.swim, gain * grown, beat_, curve);
}

// The attitude with the pitch that the fish will have in kPitchLeadBeats if it pitches on as it
// does.
BodyAngles Swimmer::foreseen() const {
    BodyAngles ahead = attitude_;
    ahead.pitchRadians +=
        attitude_.pitchRate * kPitchLeadBeats / std::max(beating_.beatHertz, fish_.timeScale);
    return ahead;
}

double Swimmer::bank() const {
    switch (order_.controller) {
        case Controller::ForwardSwim:
            return order_.bankRadians;
        case Controller::LeftTurn:
            return order_.bankRadians * bankShare(order_.bend, ownSecondsOfOrder_);
        case Controller::RightTurn:
            return -order_.bankRadians * bankShare(order_.bend, ownSecondsOfOrder_);
        default:
            return 0;
    }
}

double Swimmer::lift() const {
    return order_.controller == Controller::PitchUp ? kPitchingLift : order_.liftRadians;
}

// In water that streams from behind, a fin turned the other way has the same effect.
FinPlates Swimmer::held(double pitchRadians, double rollRadians) const {
    const FinPlates plates = hold(foreseen(), pitchRadians, rollRadians);
    return forwardSpeed() < 0 ? turnedAbout(plates) : plates;
}

double Swimmer::forwardSpeed() const {
    return glm::dot(meanOf(fish_, state_.velocities), frameOf(state_.positions).worldFromBody[0]);
}

bool Swimmer::balancesWithoutGrip() const {
    return order_.controller == Controller::Balance &&
           forwardSpeed() < kGripSpeed * fish_.timeScale;
}

FinPlates Swimmer::finProgram() const {
    switch (order_.controller) {
        case Controller::Ascend:
            return held(order_.pitchRadians);
        case Controller::Descend:
            return held(-order_.pitchRadians);
        case Controller::Brake:
            return brake();
        case Controller::ForwardSwim:
        case Controller::LeftTurn:
        case Controller::RightTurn:
            if (lift() != 0) return capture::lift(lift());
            return order_.bankRadians != 0 ? held(0, bank()) : FinPlates{};
        case Controller::Balance:
            return held(0);
        default:
            return {};
    }
}

}  // namespace aquarama::capture
