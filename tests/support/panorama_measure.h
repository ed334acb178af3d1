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

// The same for a screen of any shape, by windows along the lines: by how much, across the line, the
// composed pattern is displaced (one step of least squares, Lucas and Kanade 1981), infinite where
// no line is seen in a window of the direct one. `screen` is light where the panorama shows screen;
// windows that are not wholly on it are left out.
[[nodiscard]] std::vector<double> windowOffsets(const Light& composed,
                                                const Light& direct,
                                                const Light& screen);
// The largest relative deviation from the mean of any pixel that lies, with two pixels about it, on
// the screen.
[[nodiscard]] double unevennessOn(const Light& composed, const Light& screen);

// The largest relative deviation from the mean of any block of `blockPixels` squared, without the
// border that may stay dark (kDarkBorder of wall.h).
[[nodiscard]] double unevenness(const Light& panorama, int blockPixels);

}  // namespace aquarama::test
