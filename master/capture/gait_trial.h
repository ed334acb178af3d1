// SPDX-License-Identifier: Apache-2.0
// How hard a species must bend to turn as far as a turn is to go.
#pragma once

#include <array>
#include <string>

#include "common/config/species.h"
#include "master/capture/measure.h"

namespace aquarama::capture {

// Well inside what a gradual turn (20 to 40 degrees) and a sharp one (40 to 80) may be, whatever
// the point of the beat where it begins.
inline constexpr double kGradualDegrees = 30;
inline constexpr double kSharpDegrees = 58;

// Strengths with which left turns out of medium swimming go as far as that on the average over the
// beat, or as near as the fish can; at the tempos that the species has. Throws Error when it does
// not become straight after them.
[[nodiscard]] config::Turn withFittingStrengths(const config::Species& species);

// How a species swims straight on, in figures.

struct GaitFigures {
    double beatHertz = 0;
    SegmentMeasures swum;
    BodyWave wave;
};
using ForwardFigures = std::array<GaitFigures, 3>;  // slow, medium, fast

// As it is captured: when the beat repeats itself. Throws Error when it does not.
[[nodiscard]] GaitFigures steadyFigures(const config::Species& species, const config::Gait& gait);

// The same three gaits at a fraction of the cost and within 1 %: from a flying start, after a few
// beats, side by side on threads of their own.
[[nodiscard]] ForwardFigures quickFigures(const config::Species& species);

// How far a species' swimming is from that of living fish.

// 0 when every figure of every gait lies where living fish have it; else the sum of the squares of
// what they miss by, each in units of its own tolerance.
[[nodiscard]] double missOf(const ForwardFigures& gaits);

// The gaits of species in the figures by which fish are compared, as a table in Markdown.

[[nodiscard]] std::string gaitTableHead();
[[nodiscard]] std::string gaitTableRows(
    const config::Species& species);  // slow, medium, fast: simulated now

// How far its turns go, in degrees, when they are begun at any point of a slow, medium or fast
// beat.
[[nodiscard]] std::string turnTableHead();
[[nodiscard]] std::string turnTableRow(const config::Species& species);

}  // namespace aquarama::capture
