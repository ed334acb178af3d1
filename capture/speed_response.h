// SPDX-License-Identifier: Apache-2.0
// Steady swimming, where one period of the drive is a cycle of the fish; and how the speed of a
// fish follows a change of what it does, measured on the dynamics. Speeds are body lengths a
// second.
#pragma once

#include <array>
#include <vector>

#include "capture/compile_segment.h"
#include "capture/swimmer.h"
#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

// The criterion. A beat repeats the one before when, at each phase, no nodal point in the body
// frame differs by more than this, and neither does the path of the body frame. It is the
// resolution of a repertoire.
inline constexpr double kRepeatsBodyLengths = static_cast<double>(motion::kPoseUnit);
inline constexpr int kMostBeats = 200;

// A fish that swims steadily, and the beat that is captured.
struct SteadySwimming {
    Swimmer swimmer;        // at the end of that beat
    RecordedCycle beat;     // the first that repeats the one before
    int stepsPerPhase = 0;  // of the swimmer
    int beats = 0;          // from rest to the end of that beat
};

// Obeys the order, which has a gait, from rest on. A phase has a whole number of steps, none longer
// than longestStepSeconds(). Throws Error, naming species and gait, when no beat of the first
// kMostBeats repeats the one before.
[[nodiscard]] SteadySwimming swimUntilSteady(const config::Species& species, const Order& order);
// Straight on.
[[nodiscard]] SteadySwimming swimUntilSteady(const config::Species& species,
                                             const config::Gait& gait);

// The measure of that criterion for two beats of one gait, in body lengths; NaN where the
// simulation diverged.
[[nodiscard]] double differenceOf(const RecordedCycle& beat, const RecordedCycle& next);

// How the speed of a fish follows what it does.

// A change of speed in the dynamics, from the moment of the order on. A speed is that of the centre
// of mass; in a beat of the tail, it is the mean over one beat around the sample; in a retreat, it
// is the part along the course before the order. A fish that swims balances, as a replica does.
struct Transition {
    double sampleSeconds = 0;  // from sample to sample
    // The steady speed that it leads to; 0 for a glide and a brake, negative for a retreat.
    double segmentSpeed = 0;
    std::vector<double> speeds;
};

// The transitions of one species that fitResponse() needs.
struct Transitions {
    // Transitions to each gait from the other two.
    std::array<std::vector<Transition>, motion::kForwardGaits> swim;
    Transition glide, brake, retreat;  // out of medium swimming
};
// Slow, medium and fast, none of them null; not owned.
using SteadyGaits = std::array<const SteadySwimming*, motion::kForwardGaits>;
[[nodiscard]] Transitions swimTransitions(const config::Species& species,
                                          const SteadyGaits& gaits,
                                          const SteadySwimming& retreat);

// A fish that rows backwards or in its place. One of a species that does not row rests instead.
[[nodiscard]] Order rowingOrder(const config::Species& species, Controller controller);

// The law of motion::SpeedResponse while one segment plays, where v is the fish's speed and p the
// segment's:
//     dv/dt = swimDrag (|p| + e) (p - v) - glideDrag v |v| - brakeRate v,
// where e is motion::kExcessDrag (v - p) while v > p > 0, else 0, and glideDrag is 0 while the fish
// swims. Drags are 1 / body length, brakeRate is 1 / s.
struct SpeedLaw {
    double swimDrag = 0;
    double glideDrag = 0;
    double brakeRate = 0;
};
// dv/dt of that law, body lengths / s^2.
[[nodiscard]] double acceleration(const SpeedLaw& law, double segmentSpeed, double speed);

// Fits the coefficient k of one term of the law, `term`, where the others are known. The law is
// linear in k. Integrated over time it is v(t) - v(0) - K(t) = k X(t), where K is the integral of
// the known terms along the measured speeds and X that of the term for k = 1. This is a straight
// line through the origin, fitted by least squares over all samples: k = sum(X (v - v(0) - K)) /
// sum(X^2). Never negative; 0 where the term has no effect.
[[nodiscard]] double fitTerm(const std::vector<Transition>& transitions,
                             double SpeedLaw::*term,
                             const SpeedLaw& known);

// swimDrag of a gait is fitted to the changes to that gait, from slower and from faster ones;
// retreatDrag to the retreat; glideDrag to the glide; brakeRate, with that glideDrag, to the brake.
[[nodiscard]] motion::SpeedResponse fitResponse(const Transitions& transitions);

}  // namespace aquarama::capture
