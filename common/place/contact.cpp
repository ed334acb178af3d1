// SPDX-License-Identifier: Apache-2.0
#include "common/place/contact.h"

#include <algorithm>
#include <cmath>

namespace aquarama::place {

namespace {

constexpr float kClearMetres = 0.01F;
constexpr float kPerSecond = 40;
constexpr float kFastest = 2;
constexpr float kOutMetres = 0.3F;
constexpr float kBackPerSecond = 0.5F;
constexpr float kFastestBack = 0.1F;

float speedAt(float depthMetres) {
    return std::clamp(kPerSecond * depthMetres, 0.0F, kFastest);
}

// Back into the water along one axis.
float backAlong(float from, float half) {
    const float out = std::abs(from) - half - kOutMetres;
    return std::copysign(std::clamp(kBackPerSecond * out, 0.0F, kFastestBack), -from);
}

}  // namespace

glm::vec3 contactVelocity(const Obstacles& obstacles, glm::vec3 position, float halfWidthMetres) {
    const Region& water = obstacles.water;
    const glm::vec3 from = position - water.centre;
    glm::vec3 velocity{
        backAlong(from.x, water.halfExtent.x), 0, backAlong(from.z, water.halfExtent.z)};
    const glm::vec2 xz{position.x, position.z};
    if (!obstacles.chart.covers(xz)) return velocity;
    const float clear = halfWidthMetres + kClearMetres;
    velocity.y = speedAt(obstacles.chart.sand(xz) + clear - position.y);
    if (position.y > obstacles.chart.highestNear(xz) + clear) return velocity;
    for (const std::uint32_t i : obstacles.chart.near(xz)) {
        if (i >= obstacles.rocks.size()) break;  // stems come last
        const Rock& rock = obstacles.rocks[i];
        const glm::vec3 out = position - rock.centre;
        const float reach = kDrawnRadii * rock.radiusMetres + clear;
        if (dot(out, out) >= reach * reach) continue;
        velocity += directionOf(out, {0, 1, 0}) * speedAt(reach - lengthOf(out));
    }
    return velocity;
}

}  // namespace aquarama::place
