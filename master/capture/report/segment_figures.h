// SPDX-License-Identifier: Apache-2.0
// How well a segment meets itself where it is repeated.
#pragma once

#include <cstddef>
#include <vector>

#include "common/motion/repertoire.h"

namespace aquarama::report {

// By how much the farthest nodal point is off the smooth way of its neighbours in time (the cubic
// through two phases before and two after), in body lengths: where the last phases meet the first,
// and at most elsewhere in the cycle.
struct Seam {
    double atTheJoin = 0;
    double elsewhere = 0;
};
[[nodiscard]] Seam seamOf(const motion::ActionSegment& segment);

// What repetitions add to the course that one cycle does not tell of.
struct Drift {
    double headingRadians = 0;  // from a straight course, or beyond so many times the cycle's turn
    double leanRadians = 0;     // roll and pitch together
    double climb = 0;           // body lengths
};
[[nodiscard]] Drift driftAfter(const motion::ActionSegment& segment, int repetitions);

// The midlines of one beat, as papers on swimming fish draw them.

// Body lengths, in a frame that swims along at the mean speed.
struct Midline {
    std::vector<double> station;  // behind the mean nose
    std::vector<double> left;     // of the mean course
};
// One a phase.
[[nodiscard]] std::vector<Midline> midlinesOf(const motion::ActionSegment& gait);

// How each point of the midline swings over the beat.
struct Swing {
    std::vector<double> station;  // its mean
    std::vector<double> half;     // half of its way from side to side
};
[[nodiscard]] Swing swingOf(const std::vector<Midline>& lines);

// What the report tells of gaits and turns beside their measures of each segment.

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
