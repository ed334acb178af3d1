// SPDX-License-Identifier: Apache-2.0
// Trials of the gaits and turns of a species in the simulation: the strengths of its bends, the
// figures of its swimming, how far those are from living fish, and tables of them.
#pragma once

#include <array>
#include <string>

#include "capture/measure.h"
#include "common/config/species.h"

namespace aquarama::capture {

// The mean angles to aim at. A gradual turn must be 20 to 40 degrees and a sharp one 40 to 80;
// these leave room for the variation with the phase of the beat at which the turn begins.
inline constexpr double kGradualDegrees = 30;
inline constexpr double kSharpDegrees = 58;

// The bends of the species with strengths such that left turns out of medium swimming have those
// angles, averaged over the phases of onset, or the nearest that the fish can reach. The tempos
// stay those of the species. Throws Error when the fish does not become straight after a turn.
[[nodiscard]] config::Turn withFittingStrengths(const config::Species& species);

// The figures of straight swimming.

// The figures of one gait.
struct GaitFigures {
    double beatHertz = 0;
    SegmentMeasures swum;
    BodyWave wave;
};
using ForwardFigures = std::array<GaitFigures, 3>;  // slow, medium, fast

// Measured on the beat that would be captured, when swimming is steady. Throws Error when it does
// not become steady.
[[nodiscard]] GaitFigures steadyFigures(const config::Species& species, const config::Gait& gait);

// All three gaits at a fraction of the cost and within 1 %, for the slow trumpetfish within 7 %:
// the fish starts at an estimated speed and is measured after a few beats. Each gait runs on a
// thread of its own; returns when all are done.
[[nodiscard]] ForwardFigures quickFigures(const config::Species& species);

// How far the swimming of a species is from that of living fish: 0 when every figure of every gait
// is in the range of living fish; else the sum of the squares of the distances from the ranges,
// each in units of its own tolerance.
[[nodiscard]] double missOf(const ForwardFigures& gaits);

// Tables in Markdown.

// The gaits of a species: a row each for slow, medium and fast. The rows are simulated in the call.
[[nodiscard]] std::string gaitTableHead();
[[nodiscard]] std::string gaitTableRows(const config::Species& species);

// The least and the greatest angle of its turns in degrees, over all phases of onset, out of slow,
// medium and fast swimming.
[[nodiscard]] std::string turnTableHead();
[[nodiscard]] std::string turnTableRow(const config::Species& species);

}  // namespace aquarama::capture
