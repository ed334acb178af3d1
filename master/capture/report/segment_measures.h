// SPDX-License-Identifier: Apache-2.0
// What the report tells of gaits and turns beside their measures of each segment.
#pragma once

#include <cstddef>

#include "common/motion/repertoire.h"

namespace aquarama::report {

inline constexpr std::size_t kGaits = 3;  // the first three actions: slow, medium, fast

// speed = slope * beat + intercept, by least squares over the three gaits.
struct SpeedLine {
    double slope = 0;      // body lengths a beat
    double intercept = 0;  // body lengths a second
    double rSquared = 0;
};
[[nodiscard]] SpeedLine fitSpeed(const motion::Repertoire& repertoire);

// The mean radius of a turning cycle and the fastest turn within it.
[[nodiscard]] double turnRadius(const motion::ActionSegment& segment);    // body lengths
[[nodiscard]] double peakTurnRate(const motion::ActionSegment& segment);  // radians a second

}  // namespace aquarama::report
