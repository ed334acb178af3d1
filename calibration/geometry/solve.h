// SPDX-License-Identifier: Apache-2.0
// The joint solve: cameras, projectors and the screen's bumps from what the cameras have seen.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "calibration/geometry/solved_hall.h"
#include "calibration/scan/decode.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama::geometry {

// How far apart two channels show a point, over many points; panorama pixels. 0 without points.
struct OverlapFigures {
    std::size_t points = 0;
    double rms = 0, p95 = 0, most = 0;
};
[[nodiscard]] OverlapFigures overlapFigures(const std::vector<double>& errors);

// The errors that the solve itself knows. Panorama pixels unless said otherwise.
struct SolveFigures {
    double fitRms = 0;       // of the ties that were fitted, pixels of the projectors
    OverlapFigures overlap;  // of the ties that were held out
    double outlineRms = 0;   // pixels of the camera
    std::size_t outlinePoints = 0;
    std::size_t marks = 0;  // strips of tape that were found
    // Standard deviation of the place of the whole picture, by the camera's noise alone.
    double absoluteSigma = 0;
};

// How far apart two channels show a place that was held out.
struct Parting {
    glm::dvec2 place{};  // pixels of the panorama
    double pixels = 0;   // of the panorama
};

// The uncertainty of the picture's place over the panorama: a standard deviation in its pixels, row
// by row; NaN where no camera sees the screen.
struct UncertaintyMap {
    glm::ivec2 size{};
    std::vector<double> pixels;
};

// A solved hall, and what is known about it.
struct Solved {
    std::unique_ptr<SolvedHall> hall;
    std::vector<Tie> ties;  // with those that were held out
    SolveFigures figures;
    std::vector<scan::ScanFault> faults;
    std::vector<Parting> partings = {};
    UncertaintyMap uncertainty = {};
};

// `wall` is the rig's, without any wall file: about where the crew hung the projectors. `progress`
// is called with the name of each step. Takes seconds and uses all processors.
[[nodiscard]] Solved solveHall(const config::Rig& rig,
                               const wall::Wall& wall,
                               const std::vector<scan::CameraView>& views,
                               const std::function<void(const std::string&)>& progress);
// The same for known ties; of the views only the size and the picture of the room are used.
[[nodiscard]] Solved solveTies(const config::Rig& rig,
                               const wall::Wall& wall,
                               const std::vector<scan::CameraView>& views,
                               std::vector<Tie> ties,
                               const std::function<void(const std::string&)>& progress);

}  // namespace aquarama::geometry
