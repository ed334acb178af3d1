// SPDX-License-Identifier: Apache-2.0
// From a recording to an action segment: body-frame increments, deformations and control points
// (the paper's eq. 6-9), closed so that it can be repeated for ever.
#pragma once

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"
#include "master/capture/compile/recorded_cycle.h"

namespace aquarama::capture {

// Without control points. All throw Error where a fish reaches further than its own length.
[[nodiscard]] motion::ActionSegment compileForward(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compileLeftTurn(const RecordedCycle& recording);
[[nodiscard]] motion::ActionSegment compileRightTurn(const RecordedCycle& leftTurn);

// Eq. 9: those of each phase's nodal points.
void addControlPoints(const body::FishBody& body, motion::ActionSegment& segment);

}  // namespace aquarama::capture
