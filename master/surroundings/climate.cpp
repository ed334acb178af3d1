// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/climate.h"

#include <algorithm>

namespace aquarama::surroundings {

namespace {

// What is left of the light after a metre of clear water, to the eye of a fish; e^-0.06 by its
// series would do as well.
constexpr float kLostPerMetre = 0.02F;

}  // namespace

Climate climateOf(const config::Scene& scene) {
    return {scene.day,
            static_cast<float>(scene.water.surfaceCelsius),
            static_cast<float>(scene.water.celsiusPerMetre)};
}

float daylight(const config::Day& day, Tick tick) {
    double time = day.startsAt;
    if (day.lengthSeconds > 0)
        time += static_cast<double>(tick.value) /
                (day.lengthSeconds * static_cast<double>(kTicksPerSecond));
    time -= static_cast<double>(static_cast<std::int64_t>(time));
    // Smoothstep up to noon and down again: no libm.
    const double half = time < 0.5 ? 2 * time : 2 - 2 * time;
    const double risen = half * half * (3 - 2 * half);
    return static_cast<float>(day.night + (1 - day.night) * risen);
}

float lightAt(const Climate& /*climate*/, float daylight, float y) {
    return daylight * std::max(0.0F, 1 + kLostPerMetre * std::min(y, 0.0F));
}

float celsiusAt(const Climate& climate, float y) {
    return climate.surfaceCelsius - climate.celsiusPerMetre * std::min(y, 0.0F);
}

}  // namespace aquarama::surroundings
