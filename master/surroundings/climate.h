// SPDX-License-Identifier: Apache-2.0
// The light and temperature of the water.
#pragma once

#include "common/config/scene.h"

namespace aquarama::surroundings {

// Light and temperature of the water, as fish sense them (Tu 1996, section 5.1).

// Constant during a show. Both light and temperature depend on height and time alone.
struct Climate {
    config::Day day;
    // Temperature at the surface, and its decrease for each metre of depth.
    float surfaceCelsius = 28, celsiusPerMetre = -0.15F;
};
[[nodiscard]] Climate climateOf(const config::Scene& scene);

// Light at height y (negative under water), 0 to 1. `daylight` is that of the sky.
[[nodiscard]] float lightAt(const Climate& climate, float daylight, float y);
// Temperature at height y.
[[nodiscard]] float celsiusAt(const Climate& climate, float y);

}  // namespace aquarama::surroundings
