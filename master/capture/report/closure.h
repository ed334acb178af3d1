// SPDX-License-Identifier: Apache-2.0
// How well a segment meets itself where it is repeated.
#pragma once

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

}  // namespace aquarama::report
