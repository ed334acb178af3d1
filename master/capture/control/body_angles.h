// SPDX-License-Identifier: Apache-2.0
// How a fish lies in the water, as its controllers sense it.
#pragma once

#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama::capture {

struct BodyAngles {
    double headingRadians = 0;  // of the body's axis over the horizon, left of +x positive
    double pitchRadians = 0;    // nose up positive
    double rollRadians = 0;     // right side up positive
};

[[nodiscard]] BodyAngles bodyAnglesOf(const FishState& state);

// What is sensed now, after what was sensed before: heading and pitch by a low pass, which goes a
// share of the way, for the tail beat sways them. It does not roll the fish, and roll that is
// sensed late would rock it.
[[nodiscard]] BodyAngles sense(const BodyAngles& before, const FishState& state, double share);

}  // namespace aquarama::capture
