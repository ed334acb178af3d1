// SPDX-License-Identifier: Apache-2.0
// The joint solve: cameras, projectors and the screen's bumps from what the cameras have seen.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/scan/decode.h"
#include "calibration/solve/model.h"
#include "calibration/solve/ties.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama::solve {

struct Device {
    LensParameters lens{};
    PoseParameters pose{};
};

// What is left between the model and the measured places of a projector, smooth over its picture:
// lenses that the model does not know, and the like. Pixels.
struct Correction {
    SmoothField across{{1, 1}}, down{{1, 1}};
    [[nodiscard]] glm::dvec2 at(glm::dvec2 share) const {
        return {across.at(share), down.at(share)};
    }
};

// A solved hall: from pixels of cameras and channels to points of the screen. Immutable once
// solved; for any thread. Refers to the screen of `wall`.
class SolvedHall {
  public:
    SolvedHall(const config::Rig& rig, const wall::Wall& wall, glm::ivec2 displacementCells);

    // Nothing where the light passes the screen.
    [[nodiscard]] std::optional<BumpyScreen::Place> placeOf(std::size_t channel,
                                                            glm::dvec2 pixel) const;
    [[nodiscard]] std::optional<BumpyScreen::Place> placeSeen(std::size_t camera,
                                                              glm::dvec2 pixel) const;
    // What the model says of a place that a camera sees: a place in a channel's picture.
    [[nodiscard]] std::optional<glm::dvec2> modelled(const Tie& tie) const;
    // The place in the panorama, in its pixels, that a viewer at the sweet spot sees a point at.
    [[nodiscard]] glm::dvec2 panoramaPixel(glm::dvec3 point) const;

    const config::Rig& rig;
    const wall::Wall& nominal;
    std::vector<Device> cameras, projectors;
    std::vector<Correction> corrections;  // of each projector
    BumpyScreen screen;
};

// What the solve says of itself. Panorama pixels unless said otherwise.
struct SolveFigures {
    double fitRms = 0;  // of the ties that were fitted, pixels of the projectors
    double overlapRms = 0, overlapP95 = 0, overlapMax = 0;  // held out: between two channels
    std::size_t overlapPoints = 0;
    double outlineRms = 0;  // pixels of the camera
    std::size_t outlinePoints = 0;
    double nominalRms = 0;  // of the rig's own idea of the hall, panorama pixels
};

struct Solved {
    std::unique_ptr<SolvedHall> hall;
    std::vector<Tie> ties;  // held-out ones too
    SolveFigures figures;
    std::vector<scan::ScanFault> faults;
};

// `wall` is rig's without any wall file: where the crew hung it, about. `progress` is called with
// what is done now. Takes seconds and uses all processors. Throws Error where there is too little
// to begin with.
[[nodiscard]] Solved solveHall(const config::Rig& rig,
                               const wall::Wall& wall,
                               const std::vector<scan::CameraView>& views,
                               const std::function<void(const std::string&)>& progress);

}  // namespace aquarama::solve
