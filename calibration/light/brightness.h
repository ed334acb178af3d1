// SPDX-License-Identifier: Apache-2.0
// Evens the light and colour of projectors that differ: the light of each at each place, the light
// added to black, and the primaries that all of them reach.
#pragma once

#include <vector>

#include "calibration/geometry/solved_hall.h"
#include "calibration/light/photometry.h"
#include "common/formats/wall_file.h"

namespace aquarama::light {

// The cost of even light, as shares of the projectors' own brightest and darkest light.
struct BrightnessFigures {
    double keptLight = 1;     // of white, in the mean over the screen
    double keptContrast = 1;  // of white against black, in the mean
    double desaturation = 0;  // of the primaries, towards white, so that all projectors reach them
};

// A function over the unrolled screen (0 to 1), bilinear between the middles of its cells.
struct ScreenField {
    glm::ivec2 size{};
    std::vector<float> values;
    // The value at a place, as shares of the panorama.
    [[nodiscard]] double at(glm::dvec2 share) const;
};

// The largest function below `most` (infinite where there is no bound) whose logarithm changes by
// at most `step` between neighbouring cells, across and down: Majumder and Stevens (2005).
[[nodiscard]] ScreenField evenedBelow(ScreenField most, glm::dvec2 step);

// Sets blend, black and colour of the channels of a wall file (a3), which has the warps of the
// hall.
BrightnessFigures shade(const geometry::SolvedHall& hall,
                        const std::vector<ChannelLight>& lights,
                        formats::WallFile& file);

}  // namespace aquarama::light
