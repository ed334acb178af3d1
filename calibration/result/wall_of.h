// SPDX-License-Identifier: Apache-2.0
// Makes the wall file for render nodes from a solved hall.
#pragma once

#include <optional>

#include "calibration/geometry/solve.h"
#include "calibration/light/brightness.h"
#include "calibration/light/foresight.h"
#include "common/formats/wall_file.h"

namespace aquarama::result {

// A region for each channel, by its name. For every pixel it has the point of the rig's screen that
// a viewer at the sweet spot sees in the direction of the lit point (profile a3), which corrects
// the bumps of the screen; x is NaN where the light misses the screen. Uses all processors.
[[nodiscard]] formats::WallFile wallFileOf(const geometry::SolvedHall& hall);

// The same with light and colour, where they can be measured in the first camera's view.
struct ShadedWall {
    formats::WallFile file;
    std::optional<light::BrightnessFigures> brightness;
    std::optional<light::ForeseenSeams> seams;
};
[[nodiscard]] ShadedWall shadedWallOf(const geometry::SolvedHall& hall,
                                      const scan::CameraView& view);

}  // namespace aquarama::result
