// SPDX-License-Identifier: Apache-2.0
// From a recording to an action segment: body-frame increments, deformations and control points
// (the paper's eq. 6-9), closed so that it can be repeated for ever.
#pragma once

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"
#include "master/capture/compile/recording.h"

namespace aquarama {

[[nodiscard]] ActionSegment compileForward(const FishBody& body, const Recording& recording);
[[nodiscard]] ActionSegment compileLeftTurn(const FishBody& body, const Recording& recording);
[[nodiscard]] ActionSegment compileRightTurn(const FishBody& body, const Recording& leftTurn);

}  // namespace aquarama
