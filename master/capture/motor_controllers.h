// SPDX-License-Identifier: Apache-2.0
// What the muscles do at each instant.
#pragma once

#include "common/config/species.h"
#include "master/capture/biomechanical_fish.h"
#include "master/capture/swimmer.h"

namespace aquarama::capture {

// Between the two, muscle by muscle.
[[nodiscard]] MuscleActivation mix(const MuscleActivation& from,
                                   const MuscleActivation& to,
                                   double share);
// Left for right.
[[nodiscard]] MuscleActivation mirrored(const MuscleActivation& muscles);

// Swimming, at a point of the beat from 0 to 1: middle and back muscles beat left against right,
// the back ones later, so that a wave runs down the body (Tu 1996, swim-MC).
[[nodiscard]] MuscleActivation beatAt(const config::Swim& swim, double gain, double beat);

// A bend of the whole body to the left, quick to come and slow to go, so that the shape recovers
// without undoing the turn (Tu & Terzopoulos 1994, turn-MC).
[[nodiscard]] MuscleActivation bendLeft(const config::Bend& bend, double ownSeconds);

// Swimming from rest: over so many of the fish's own seconds the beat grows.
inline constexpr double kRampOwnSeconds = 1;
[[nodiscard]] MuscleActivation swim(const config::Species& species,
                                    const config::Gait& gait,
                                    double seconds);

// From the order to turn until all muscles are relaxed.
[[nodiscard]] double secondsOf(const config::Bend& bend, const config::Species& species);

// What the pectoral fins do at each instant.

// Towards a pitch and upright, for a fish that moves forward: both fins lift the head by what the
// pitch lacks, and one against the other the lower side (Tu & Terzopoulos 1994 give the fins' law;
// this feedback is ours).
[[nodiscard]] PectoralFins hold(const BodyAngles& attitude, double pitchRadians);

// Both fins across the stream (Tu & Terzopoulos 1994, brake-MC).
[[nodiscard]] PectoralFins brake();

// Backward: the fins row, broadside on the way forward and feathered on the way back, at a point of
// the stroke from 0 to 1. The stroke that turns the fish back to its heading is the longer one; on
// the way back the fins trim pitch and roll. Tu names a retreat and does not say how; fish row.
[[nodiscard]] PectoralFins row(const config::Gait& gait,
                               double stroke,
                               const BodyAngles& attitude,
                               double headingRadians);

}  // namespace aquarama::capture
