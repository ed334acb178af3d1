// SPDX-License-Identifier: Apache-2.0
// The figures of a repertoire as tables of HTML, beside those of living fish.
#pragma once

#include <string>

#include "common/motion/repertoire.h"

namespace aquarama::report {

// What the file is: length of the fish, format, digest, what is recorded, speed response.
[[nodiscard]] std::string fileTable(const motion::Repertoire& repertoire);
// The three gaits.
[[nodiscard]] std::string forwardTable(const motion::Repertoire& repertoire);
// The four turns.
[[nodiscard]] std::string turnTable(const motion::Repertoire& repertoire);
// How each segment closes, after 1 and 100 repetitions, and its largest step.
[[nodiscard]] std::string closureTable(const motion::Repertoire& repertoire);

// The mean radius of a turning cycle and the fastest turn within it.
[[nodiscard]] double turnRadius(const motion::ActionSegment& segment);    // body lengths
[[nodiscard]] double peakTurnRate(const motion::ActionSegment& segment);  // radians a second

}  // namespace aquarama::report
