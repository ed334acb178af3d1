// SPDX-License-Identifier: Apache-2.0
// How a species swims straight on, in figures.
#pragma once

#include <array>

#include "common/config/species.h"
#include "master/capture/measure/body_wave.h"
#include "master/capture/measure/measure.h"

namespace aquarama::search {

struct GaitFigures {
    double beatHertz = 0;
    capture::SegmentMeasures swum;
    capture::BodyWave wave;
};
using ForwardFigures = std::array<GaitFigures, 3>;  // slow, medium, fast

// As it is captured: when the beat repeats itself. Throws Error when it does not.
[[nodiscard]] GaitFigures steadyFigures(const config::Species& species, const config::Gait& gait);

// The same three gaits at a fraction of the cost and within 1 %: from a flying start, after a few
// beats, side by side on threads of their own.
[[nodiscard]] ForwardFigures quickFigures(const config::Species& species);

}  // namespace aquarama::search
