// SPDX-License-Identifier: Apache-2.0
// Swimming until the beat repeats itself: only then is one period of the drive a cycle of the fish.
#pragma once

#include <array>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/compile_segment.h"
#include "master/capture/swimmer.h"

namespace aquarama::capture {

// The criterion. A beat repeats the one before when no nodal point differs by more than this, in
// the body frame, at any phase, nor does the way of the body frame: the finest that a repertoire
// can tell.
inline constexpr double kRepeatsBodyLengths = static_cast<double>(motion::kPoseUnit);
inline constexpr int kMostBeats = 200;

struct SteadySwimming {
    Swimmer swimmer;        // at the end of that beat
    RecordedCycle beat;     // the first that repeats the one before
    int stepsPerPhase = 0;  // of the swimmer
    int beats = 0;          // from rest to the end of that beat
};

// From rest, with a whole number of steps to a phase, none longer than the longest that swims well.
// Throws Error, naming species and gait, when kMostBeats do not bring two that are alike.
[[nodiscard]] SteadySwimming swimUntilSteady(const config::Species& species,
                                             const config::Gait& gait);

// The criterion's measure for two beats of one gait, in body lengths; NaN where a fish flew apart.
[[nodiscard]] double differenceOf(const RecordedCycle& beat, const RecordedCycle& next);

// How a fish's speed follows what it plays, measured on the dynamics.

// A change of speed as the dynamics swam it, from the tick at which it was told to. Speeds in body
// lengths a second: of the centre of mass along its course; while the tail beats, the mean over the
// beat around.
struct Transition {
    double sampleSeconds = 0;
    double segmentSpeed = 0;  // what it goes to
    std::vector<double> speeds;
};

struct Transitions {
    std::array<std::vector<Transition>, motion::kForwardGaits>
        swim;                 // to each gait from the other two
    Transition glide, brake;  // out of medium swimming
};
using SteadyGaits = std::array<const SteadySwimming*, motion::kForwardGaits>;
[[nodiscard]] Transitions swimTransitions(const config::Species& species, const SteadyGaits& gaits);

// The law of SpeedResponse while one segment plays, p being its speed:
//     dv/dt = swimDrag |p| (p - v) - glideDrag v |v| - brakeRate v,
// where glideDrag is 0 while the fish swims.
struct SpeedLaw {
    double swimDrag = 0;
    double glideDrag = 0;
    double brakeRate = 0;
};
[[nodiscard]] double acceleration(const SpeedLaw& law, double segmentSpeed, double speed);

// The coefficient k of a law's term that explains best what the known terms leave. The law is
// linear in k. Integrated over time, v(t) - v(0) - K(t) = k X(t), with K the integral of the known
// terms along the measured speeds and X that of the term: a straight line through the origin,
// fitted by least squares over all samples, k = sum(X (v - v(0) - K)) / sum(X^2). Never negative.
[[nodiscard]] double fitTerm(const std::vector<Transition>& transitions,
                             double SpeedLaw::*term,
                             const SpeedLaw& known);

// swimDrag of a gait from the changes to it, whether they gather speed or lose it; glideDrag from
// the glide, and with it brakeRate from the brake.
[[nodiscard]] motion::SpeedResponse fitResponse(const Transitions& transitions);

}  // namespace aquarama::capture
