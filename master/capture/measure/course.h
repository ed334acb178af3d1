// SPDX-License-Identifier: Apache-2.0
// A segment replayed in a world that a reader can use.
#pragma once

#include <vector>

#include "master/capture/measure/measure.h"

namespace aquarama::capture {

// As replay(), turned about its origin so that the fish heads along +x and is level: what beats on,
// in the mean over a cycle, since the tail sways the body frame; a turn that plays to its end, at
// its start. y is up, z to the right.
[[nodiscard]] std::vector<ReplayedPhase> replayAlongX(const motion::ActionSegment& segment,
                                                      int cycles);

}  // namespace aquarama::capture
