// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/contact.h"

#include <algorithm>

namespace aquarama::surroundings {

namespace {

constexpr float kPerSecond = 10;
constexpr float kFastest = 0.6F;

float speedAt(float depthMetres) {
    return std::clamp(kPerSecond * depthMetres, 0.0F, kFastest);
}

}  // namespace

glm::vec3 contactVelocity(const Obstacles& obstacles, glm::vec3 position, float halfWidthMetres) {
    const glm::vec2 xz{position.x, position.z};
    if (!obstacles.chart.covers(xz)) return {};
    const float sand = obstacles.chart.sand(xz) + halfWidthMetres;
    glm::vec3 velocity{0, speedAt(sand - position.y), 0};
    for (const std::uint32_t i : obstacles.chart.near(xz)) {
        if (i >= obstacles.rocks.size()) break;  // stems come last
        const place::Rock& rock = obstacles.rocks[i];
        const glm::vec3 out = position - rock.centre;
        const float reach = place::kDrawnRadii * rock.radiusMetres + halfWidthMetres;
        if (place::dot(out, out) >= reach * reach) continue;
        velocity += place::directionOf(out, {0, 1, 0}) * speedAt(reach - place::lengthOf(out));
    }
    return velocity;
}

}  // namespace aquarama::surroundings
