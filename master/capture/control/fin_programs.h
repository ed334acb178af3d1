// SPDX-License-Identifier: Apache-2.0
// What the pectoral fins do at each instant.
#pragma once

#include "common/config/species.h"
#include "master/capture/control/body_angles.h"
#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama::capture {

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
