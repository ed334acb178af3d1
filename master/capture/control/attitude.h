// SPDX-License-Identifier: Apache-2.0
// How a fish lies in the water, as its controllers sense it.
#pragma once

#include "master/capture/dynamics/biomechanical_fish.h"

namespace aquarama {

struct Attitude {
    double headingRadians = 0;  // of the body's axis over the horizon, left of +x positive
    double pitchRadians = 0;    // nose up positive
    double rollRadians = 0;     // right side up positive
};

[[nodiscard]] Attitude attitudeOf(const FishState& state);

// A share of the way from one to the other, by the short way round: the low pass that takes the
// tail beat out of what is sensed.
[[nodiscard]] Attitude mix(const Attitude& from, const Attitude& to, double share);

}  // namespace aquarama
