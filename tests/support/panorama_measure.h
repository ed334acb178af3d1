// SPDX-License-Identifier: Apache-2.0
// How far a composed panorama is from one wall: where the grid's lines are, and how flat grey is.
#pragma once

#include <vector>

#include "common/base/picture.h"
#include "common/config/rig.h"

namespace aquarama::test {

struct LineOffset {
    bool upright = false;     // a line of equal azimuth, else one of equal elevation
    double lineDegrees = 0;   // which one
    glm::dvec2 atPixels{};    // where it was measured, panorama
    double offsetPixels = 0;  // across the line: composed less direct; infinite where it is missing
};

// The grid's lines in two panoramas of one rig, measured by their centroids every few rows and
// columns, away from crossings and from the screen's edges.
[[nodiscard]] std::vector<LineOffset> lineOffsets(const config::Rig& rig,
                                                  const Light& composed,
                                                  const Light& direct);

// The largest relative deviation from the mean of any block of `blockPixels` squared, without the
// border that may stay dark (kDarkBorder of wall.h).
[[nodiscard]] double unevenness(const Light& panorama, int blockPixels);

}  // namespace aquarama::test
