// SPDX-License-Identifier: Apache-2.0
// From a solved hall to the wall file that render nodes take.
#pragma once

#include <optional>

#include "calibration/geometry/solve.h"
#include "calibration/light/brightness.h"
#include "calibration/light/foresight.h"
#include "common/formats/wall_file.h"

namespace aquarama::result {

// A region for each channel, by its name: for every pixel the point of the rig's screen behind
// which a viewer at the sweet spot sees what it lights (profile a3). Seen from there the bumps of
// the screen are undone; x is NaN where the light passes the screen. Uses all processors.
[[nodiscard]] formats::WallFile wallFileOf(const geometry::SolvedHall& hall);

// The same with light and colour, where the first camera's view tells of them.
struct ShadedWall {
    formats::WallFile file;
    std::optional<light::BrightnessFigures> brightness;
    std::optional<light::ForeseenSeams> seams;
};
[[nodiscard]] ShadedWall shadedWallOf(const geometry::SolvedHall& hall,
                                      const scan::CameraView& view);

}  // namespace aquarama::result
