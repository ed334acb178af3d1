// SPDX-License-Identifier: Apache-2.0
// The light of sun, moon and sky over a day.
#pragma once

#include <glm/vec3.hpp>

namespace aquarama::scene {

// What there is of noon's light, linear Rec. 709: 1 each at noon.
struct DayLight {
    glm::vec3 sun{1.0F};  // of the sun's light, at night of the moon's, which comes the same way
    glm::vec3 sky{1.0F};  // of the sky's
    float lamp = 1.0F;    // of the floodlight's power
};

// The light at a time of day (0 and 1 midnight, 0.5 noon) where the sky's brightness is `daylight`,
// 0 to 1. Exactly 1 at noon where that is 1. Never 0, so that the wall is not dark at night.
[[nodiscard]] DayLight dayLightAt(float timeOfDay, float daylight);

}  // namespace aquarama::scene
