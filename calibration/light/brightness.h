// SPDX-License-Identifier: Apache-2.0
// One picture in light and colour of projectors that differ: how much each gives at each place,
// what is added to black, and the primaries that all of them reach.
#pragma once

#include <vector>

#include "calibration/geometry/solved_hall.h"
#include "calibration/light/photometry.h"
#include "common/formats/wall_file.h"

namespace aquarama::light {

// What even light costs. Shares of what the projectors would give at their brightest and darkest.
struct BrightnessFigures {
    double keptLight = 1;     // of white, in the mean over the screen
    double keptContrast = 1;  // of white against black, in the mean
    double desaturation = 0;  // of the primaries, towards white, so that all projectors reach them
};

// A function over the unrolled screen (0 to 1), bilinear between the middles of its cells.
struct ScreenField {
    glm::ivec2 size{};
    std::vector<float> values;
    [[nodiscard]] double at(glm::dvec2 share) const;
};

// The largest function below `most` (infinite where nothing is asked) whose logarithm changes by no
// more than `step` from a cell to the next across and down: Majumder and Stevens (2005).
[[nodiscard]] ScreenField evenedBelow(ScreenField most, glm::dvec2 step);

// Puts blend, black and colour into the channels of a wall file (a3) of the hall, which has its
// warps.
BrightnessFigures shade(const geometry::SolvedHall& hall,
                        const std::vector<ChannelLight>& lights,
                        formats::WallFile& file);

}  // namespace aquarama::light
