// SPDX-License-Identifier: Apache-2.0
// How a fish's speed follows what it plays, measured on the dynamics.
#pragma once

#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/compile/steady_swimming.h"

namespace aquarama {

// A change of speed as the dynamics swam it. Speeds in body lengths a second: of the centre of mass
// along its course; while the tail beats, the mean over one beat.
struct Transition {
    double sampleSeconds = 0;
    double segmentSpeed = 0;  // what it goes to
    std::vector<double> speeds;
};

struct Transitions {
    Transition slowToFast, mediumToSlow;  // swimming
    Transition glide, brake;              // out of medium swimming
};
[[nodiscard]] Transitions swimTransitions(const Species& species,
                                          const SteadySwimming& slow,
                                          const SteadySwimming& medium,
                                          const SteadySwimming& fast);

// The drag k of dv/dt = k (s|s| - v|v|) that explains transitions best. Integrated over time,
// v(t) - v(0) = k X(t) with X the integral of s|s| - v|v|: a straight line through the origin,
// fitted by least squares over all samples, k = sum(X (v - v(0))) / sum(X^2). Never negative.
[[nodiscard]] double fitDrag(const std::vector<Transition>& transitions);

// The speeds of a fish that obeys the law, from the transition's first speed on.
[[nodiscard]] std::vector<double> replayLaw(const Transition& transition, double drag);

// swimDrag from the change to a faster gait: most changes are, since every turn slows the fish
// down. (To a slower one the speed falls more slowly than it rises.) glideDrag from the glide,
// brakeDrag from what the brake needs beyond that.
[[nodiscard]] SpeedResponse fitResponse(const Transitions& transitions);

}  // namespace aquarama
