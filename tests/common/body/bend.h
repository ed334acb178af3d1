// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace aquarama::body {

// Along a circle whose centre is at the fish's right (a negative radius: left), beside its nose.
inline glm::vec3 bentToTheRight(glm::vec3 p, float radius) {
    const float angle = -p.x / radius;
    return {-(radius - p.z) * std::sin(angle), p.y, radius - (radius - p.z) * std::cos(angle)};
}

}  // namespace aquarama::body
