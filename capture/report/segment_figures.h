// SPDX-License-Identifier: Apache-2.0
// Figures of segments for the report: how well a segment closes, the midlines of a beat, speed
// against beat frequency, radius and rate of turns. Lengths are body lengths; pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include "common/motion/repertoire.h"

namespace aquarama::report {

// Closure of the pose: the greatest distance of a nodal point from a smooth path, the cubic through
// its places two and one phases before and one and two after, in body lengths.
struct Seam {
    // At the phases whose neighbours lie on both sides of the end of the cycle; at all others.
    double atTheJoin = 0;
    double elsewhere = 0;
};
[[nodiscard]] Seam seamOf(const motion::ActionSegment& segment);

// Closure of the motion: the errors that add up over repetitions.
struct Drift {
    // Change of heading. For a curve or turn, beyond `repetitions` times its own angle.
    double headingRadians = 0;
    double leanRadians = 0;  // roll and pitch together
    double climb = 0;        // body lengths
};
// `repetitions` >= 1.
[[nodiscard]] Drift driftAfter(const motion::ActionSegment& segment, bool turns, int repetitions);

// The midlines of one beat, as papers on swimming fish draw them, in a frame that moves with the
// mean velocity. Each has kMidlinePoints points, from nose to tail.
struct Midline {
    std::vector<double> station;  // distance behind the mean place of the nose
    std::vector<double> left;     // distance to the left of the mean course
};
// One midline for each phase.
[[nodiscard]] std::vector<Midline> midlinesOf(const motion::ActionSegment& gait);

// The lateral motion of each point of the midline over the beat.
struct Swing {
    std::vector<double> station;  // mean over the beat
    std::vector<double> half;     // amplitude: half of the travel from side to side
};
// `lines` is not empty.
[[nodiscard]] Swing swingOf(const std::vector<Midline>& lines);

// Gaits and turns.

inline constexpr std::size_t kGaits = 3;  // the first three actions: slow, medium, fast

// speed = slope * beat frequency + intercept, by least squares over the three gaits.
struct SpeedLine {
    double slope = 0;      // body lengths a beat
    double intercept = 0;  // body lengths a second
    double rSquared = 0;   // coefficient of determination
};
[[nodiscard]] SpeedLine fitSpeed(const motion::Repertoire& repertoire);

// The mean radius of a turn, body lengths: path by angle. Infinite for a segment that does not
// turn.
[[nodiscard]] double turnRadius(const motion::ActionSegment& segment);
// The greatest rate of turn from one phase to the next, radians a second, without sign.
[[nodiscard]] double peakTurnRate(const motion::ActionSegment& segment);

}  // namespace aquarama::report
