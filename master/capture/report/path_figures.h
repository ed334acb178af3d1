// SPDX-License-Identifier: Apache-2.0
// Where segments take a fish, from above.
#pragma once

#include <string>

#include "common/motion/repertoire.h"

namespace aquarama::report {

// A segment frame by frame, as the paper's Figs. 3 and 4: in each frame the bent body and, up to
// that frame, the x axis (dark) and the z axis (light) of the body frame.
[[nodiscard]] std::string drawSegment(const motion::ActionSegment& segment);

// The way of the body frame's origin in each turn, from one start, and the heading at its end.
[[nodiscard]] std::string drawTurns(const motion::Repertoire& repertoire);

// The heading over each turn.
[[nodiscard]] std::string drawHeadings(const motion::Repertoire& repertoire);

// The straight fish from the side and from above: its 23 nodal points, their 91 springs, its 12
// muscles; and its skin, where control points are recorded.
[[nodiscard]] std::string drawBody(const motion::Repertoire& repertoire);

}  // namespace aquarama::report
