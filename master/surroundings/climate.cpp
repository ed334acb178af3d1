// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/climate.h"

#include <algorithm>

namespace aquarama::surroundings {

namespace {

// Share of the surface light that a metre of water takes away. A straight line in place of the
// exponential law, because the master uses no libm.
constexpr float kLostPerMetre = 0.02F;

}  // namespace

Climate climateOf(const config::Scene& scene) {
    return {scene.day,
            static_cast<float>(scene.water.surfaceCelsius),
            static_cast<float>(scene.water.celsiusPerMetre)};
}

float lightAt(const Climate& /*climate*/, float daylight, float y) {
    return daylight * std::max(0.0F, 1 + kLostPerMetre * std::min(y, 0.0F));
}

float celsiusAt(const Climate& climate, float y) {
    return climate.surfaceCelsius - climate.celsiusPerMetre * std::min(y, 0.0F);
}

}  // namespace aquarama::surroundings
