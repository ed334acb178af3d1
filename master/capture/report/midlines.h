// SPDX-License-Identifier: Apache-2.0
// The midlines of one beat, as papers on swimming fish draw them.
#pragma once

#include <vector>

#include "common/motion/repertoire.h"

namespace aquarama::report {

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

}  // namespace aquarama::report
