// SPDX-License-Identifier: Apache-2.0
// The pictures of the report, as SVG.
#pragma once

#include <string>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama {

// A segment frame by frame from above, as the paper's Figs. 3 and 4: in each frame the bent body
// and, up to that frame, the x axis (dark) and the z axis (light) of the body frame.
[[nodiscard]] std::string drawSegment(const FishBody& body,
                                      const ActionSegment& segment,
                                      int cycles);

// The midlines of one beat over each other, in a frame that swims along at the mean speed, and the
// envelope of a saithe's.
[[nodiscard]] std::string drawMidlines(const FishBody& body, const ActionSegment& segment);

}  // namespace aquarama
