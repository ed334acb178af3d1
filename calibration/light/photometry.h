// SPDX-License-Identifier: Apache-2.0
// How each projector shines, from the levels of a scan. The camera's linear red, green
// and blue are taken for those of Rec. 709; all light is in units of the camera's most.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>

#include "calibration/geometry/model.h"
#include "calibration/scan/decode.h"
#include "common/config/rig.h"

namespace aquarama::light {

// One projector.
struct ChannelLight {
    // Luminance on the screen of its full white without its black, over the picture (0 to 1).
    geometry::SmoothField white{{1, 1}};
    double black = 0;  // as a share of white
    // Its full red, green and blue as columns, without black; their sum has the luminance one.
    glm::dmat3 primaries{1};
    // Light of its colours for codes that are spread evenly from 0 to 1.
    std::array<std::vector<float>, 3> response;
};

// Of each channel; places of the view that are not a number are left out. Nothing where it lacks a
// channel's white, red, green or levels, or sees too little of one.
[[nodiscard]] std::optional<std::vector<ChannelLight>> measureLight(const config::Rig& rig,
                                                                    scan::CameraView view);

// A smooth curve through points (x and y rising) that rises everywhere, after Fritsch and Carlson
// (1980), at rising places; before the first point it is straight.
[[nodiscard]] std::vector<double> risingCurve(const std::vector<glm::dvec2>& points,
                                              const std::vector<double>& at);

}  // namespace aquarama::light
