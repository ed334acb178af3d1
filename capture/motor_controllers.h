// SPDX-License-Identifier: Apache-2.0
// The motor controllers as pure functions of time and attitude: what the muscles do at each
// instant, and what the pectoral fins do. Swimmer chooses among them.
#pragma once

#include "capture/biomechanical_fish.h"
#include "capture/swimmer.h"
#include "common/config/species.h"

namespace aquarama::capture {

// Linear interpolation muscle by muscle: `from` at a share of 0, `to` at 1.
[[nodiscard]] MuscleActivation mix(const MuscleActivation& from,
                                   const MuscleActivation& to,
                                   double share);
// Left and right exchanged.
[[nodiscard]] MuscleActivation mirrored(const MuscleActivation& muscles);

// Swimming at a phase of the beat, in beats: of `beat` only the fraction counts. Middle and back
// muscles contract left and right in turn, as sines. The back ones follow later by
// swim.backLagRadians, so that a wave travels down the body (Tu 1996, swim-MC). The activations are
// proportional to `gain` and are not clamped here. On a curve, those of the left are 1 + curve
// times as strong and those of the right 1 - curve times.
[[nodiscard]] MuscleActivation beatAt(const config::Swim& swim,
                                      double gain,
                                      double beat,
                                      double curve = 0);

// A bend of the whole body to the left, at a time since the order. The muscles contract quickly and
// relax slowly, so that the body straightens without undoing the turn (Tu & Terzopoulos 1994,
// turn-MC). Zero before the order and after the bend.
[[nodiscard]] MuscleActivation bendLeft(const config::Bend& bend, double ownSeconds);

// How far a fish is rolled into a bend, 0 to 1.
[[nodiscard]] double bankShare(const config::Bend& bend, double ownSeconds);

// Swimming from rest: the amplitude of the beat grows linearly over this many of the fish's own
// seconds.
inline constexpr double kRampOwnSeconds = 1;
// beatAt() with that ramp; `seconds` since the fish was at rest.
[[nodiscard]] MuscleActivation swim(const config::Species& species,
                                    const config::Gait& gait,
                                    double seconds);

// From the order to turn until all muscles are relaxed, in seconds (not the fish's own).
[[nodiscard]] double secondsOf(const config::Bend& bend, const config::Species& species);

// A fast start to the left at a time since the order. `bendShare` scales the time of the bend, and
// with it the angle. `before` are the muscles when the order came. After the stroke the fish swims
// on at the fast gait.
[[nodiscard]] MotorControl startLeft(const config::Species& species,
                                     double bendShare,
                                     const MuscleActivation& before,
                                     double seconds);
// The phase of the beat with which it swims on, in beats, at a time since the order.
[[nodiscard]] double startBeat(const config::Species& species, double bendShare, double seconds);
// From the order to the end of the stroke, and until the tissue is as before.
[[nodiscard]] double secondsOf(const config::FastStart& start, double bendShare);
[[nodiscard]] double secondsUntilRelaxed(const config::Species& species, double bendShare);

// Control of the pectoral fins at each instant.

// Proportional feedback towards a pitch and a roll, for a fish that moves forward: both fins turn
// by the error of the pitch, and in opposite directions by that of the roll (the force law of the
// fins is Tu & Terzopoulos 1994's; this feedback is ours).
[[nodiscard]] FinPlates hold(const BodyAngles& attitude,
                             double pitchRadians,
                             double rollRadians = 0);

// Each fin at the same angle to the other side of parallel to the flow.
[[nodiscard]] FinPlates turnedAbout(const FinPlates& plates);

// Both fins at the same angle from parallel to the flow: the head of a fish that swims forward is
// lifted by a positive one.
[[nodiscard]] FinPlates lift(double radians);

// Both fins perpendicular to the flow (Tu & Terzopoulos 1994, brake-MC).
[[nodiscard]] FinPlates brake();

// How one pectoral fin rows. Drive 1 rows ahead, -1 back, 0 neither. The lift is that of a fin
// that moves ahead: a fin that rows twists by it against its drive. `share` scales the stroke.
struct FinStroke {
    double drive = 1, lift = 0, share = 1;
    double openRadians = 0;
};
// The pose of a fin that rows, at a phase of the beat in beats, and its change but for that of its
// opening (Rowing of species.proto).
[[nodiscard]] BladeMotion strokeAt(const config::Rowing& rowing,
                                   const FinStroke& stroke,
                                   double beatHertz,
                                   double beat);

}  // namespace aquarama::capture
