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

// What the solve says of itself. Panorama pixels unless said otherwise.
struct SolveFigures {
    double fitRms = 0;  // of the ties that were fitted, pixels of the projectors
    double overlapRms = 0, overlapP95 = 0, overlapMax = 0;  // held out: between two channels
    std::size_t overlapPoints = 0;
    double outlineRms = 0;  // pixels of the camera
    std::size_t outlinePoints = 0;
    std::size_t marks = 0;  // strips of tape that were found
    // How well the whole picture's place is known, by the noise alone.
    double absoluteSigma = 0;
};

// How far apart two channels show a place that was held out, panorama pixels.
struct Parting {
    glm::dvec2 place{};  // in the panorama, in its pixels
    double pixels = 0;
};

// How well the place of what is shown is known over the panorama, by the errors of what was seen: a
// standard deviation in its pixels, row by row; not a number where no camera sees the screen.
struct UncertaintyMap {
    glm::ivec2 size{};
    std::vector<double> pixels;
};

struct Solved {
    std::unique_ptr<SolvedHall> hall;
    std::vector<Tie> ties;  // held-out ones too
    SolveFigures figures;
    std::vector<scan::ScanFault> faults;
    std::vector<Parting> partings = {};
    UncertaintyMap uncertainty = {};
};

// `wall` is rig's without any wall file: where the crew hung it, about. `progress` is called with
// what is done now. Takes seconds and uses all processors.
[[nodiscard]] Solved solveHall(const config::Rig& rig,
                               const wall::Wall& wall,
                               const std::vector<scan::CameraView>& views,
                               const std::function<void(const std::string&)>& progress);
// The same of ties that are known; of a view only its size and the picture of the room count.
[[nodiscard]] Solved solveTies(const config::Rig& rig,
                               const wall::Wall& wall,
                               const std::vector<scan::CameraView>& views,
                               std::vector<Tie> ties,
                               const std::function<void(const std::string&)>& progress);

}  // namespace aquarama::geometry
