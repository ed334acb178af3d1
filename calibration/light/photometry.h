// SPDX-License-Identifier: Apache-2.0
// Measures the light of each projector from the levels of a scan. The camera's linear red, green
// and blue are assumed to be those of Rec. 709; light is in units of the camera's maximum.
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

// The light of one projector.
struct ChannelLight {
    // Luminance of its full white on the screen, without its black, over the picture (0 to 1).
    geometry::SmoothField white{{1, 1}};
    double black = 0;  // as a share of white
    // Its full red, green and blue as columns, without black; their sum has the luminance one.
    glm::dmat3 primaries{1};
    // The light of red, green and blue for codes at equal steps from 0 to 1.
    std::array<std::vector<float>, 3> response;
};

// Measures each channel; places that are NaN are left out. Nothing where the view lacks a channel's
// white, red, green or levels, or sees too little of it.
[[nodiscard]] std::optional<std::vector<ChannelLight>> measureLight(const config::Rig& rig,
                                                                    scan::CameraView view);

// The values, at rising places, of a smooth curve through points (x and y rising). It rises
// everywhere (Fritsch and Carlson 1980) and is straight before the first point.
[[nodiscard]] std::vector<double> risingCurve(const std::vector<glm::dvec2>& points,
                                              const std::vector<double>& at);

}  // namespace aquarama::light
