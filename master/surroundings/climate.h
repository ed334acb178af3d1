// SPDX-License-Identifier: Apache-2.0
// Light and warmth of the water, as fish sense them (Tu 1996, section 5.1).
#pragma once

#include "common/config/scene.h"
#include "common/units/ids.h"

namespace aquarama::surroundings {

struct Climate {
    config::Day day;
    float surfaceCelsius = 28, celsiusPerMetre = -0.15F;
};
[[nodiscard]] Climate climateOf(const config::Scene& scene);

// 1 at noon, Day::night at midnight, a smooth wave between; the sky's, before the water takes any.
[[nodiscard]] float daylight(const config::Day& day, Tick tick);
// At a height y (negative), 0 to 1.
[[nodiscard]] float lightAt(const Climate& climate, float daylight, float y);
[[nodiscard]] float celsiusAt(const Climate& climate, float y);

}  // namespace aquarama::surroundings
