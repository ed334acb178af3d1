// SPDX-License-Identifier: Apache-2.0
// Swimming until the beat repeats itself: only then is one period of the drive a cycle of the fish.
#pragma once

#include "common/config/species.h"
#include "master/capture/compile/recorded_cycle.h"
#include "master/capture/control/swimmer.h"

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

}  // namespace aquarama::capture
