// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/obstacles.h"

#include <algorithm>

#include "common/place/angle.h"

namespace aquarama {

namespace {

constexpr float kSideMarginMetres = 0.8F;     // where the push of an upright border begins
constexpr float kHeightMarginMetres = 0.45F;  // of the floor, the surface and the water's own
constexpr float kFloorClearanceMetres = 0.35F;
constexpr float kSurfaceClearanceMetres = 0.5F;
constexpr float kRockClearanceMetres = 0.3F;
constexpr float kRockMarginMetres = 0.6F;
constexpr float kStrongest = 6.0F;

// 0 at the margin's beginning, 1.5 at the limit, growing with the square beyond.
float ramp(float beyondMarginMetres, float marginMetres) {
    if (beyondMarginMetres <= 0) return 0;
    const float share = beyondMarginMetres / marginMetres;
    return std::min(1.5F * share * share, kStrongest);
}

float borderPush(float fromCentre, float halfExtent, float margin) {
    const float inner = halfExtent - margin;
    return fromCentre > 0 ? -ramp(fromCentre - inner, margin) : ramp(-fromCentre - inner, margin);
}

glm::vec3 bordersAt(const Obstacles& obstacles, glm::vec3 position) {
    const glm::vec3 from = position - obstacles.water.centre;
    const glm::vec3 half = obstacles.water.halfExtent;
    const float floor = floorHeight(obstacles.place, {position.x, position.z});
    const float lowest = floor + kFloorClearanceMetres + kHeightMarginMetres;
    const float highest = -kSurfaceClearanceMetres - kHeightMarginMetres;
    return {borderPush(from.x, half.x, kSideMarginMetres),
            borderPush(from.y, half.y, kHeightMarginMetres) +
                ramp(lowest - position.y, kHeightMarginMetres) -
                ramp(position.y - highest, kHeightMarginMetres),
            borderPush(from.z, half.z, kSideMarginMetres)};
}

}  // namespace

glm::vec3 ballPush(
    glm::vec3 centre, float radius, glm::vec3 position, glm::vec3 heading, float reachMetres) {
    const float along = std::clamp(dot(centre - position, heading), 0.0F, reachMetres);
    const glm::vec3 away = position + heading * along - centre;
    const float gap = lengthOf(away) - radius;
    if (gap >= kRockMarginMetres) return {};
    // What is near counts more than what the path meets later.
    const float soon = 1 - 0.5F * along / reachMetres;
    return directionOf(away, {0, 1, 0}) * (soon * ramp(kRockMarginMetres - gap, kRockMarginMetres));
}

Obstacles obstaclesOf(const PlaceKey& place, const Region& water) {
    Obstacles obstacles{place, water, {}};
    for (const Rock& rock : rocksOf(place)) {
        const glm::vec3 from = rock.centre - water.centre;
        const float reach = rock.radiusMetres + kRockClearanceMetres + kRockMarginMetres;
        const glm::vec3 nearest{std::clamp(from.x, -water.halfExtent.x, water.halfExtent.x),
                                std::clamp(from.y, -water.halfExtent.y, water.halfExtent.y),
                                std::clamp(from.z, -water.halfExtent.z, water.halfExtent.z)};
        if (lengthOf(from - nearest) < reach) obstacles.rocks.push_back(rock);
    }
    return obstacles;
}

glm::vec3 avoidance(const Obstacles& obstacles,
                    glm::vec3 position,
                    glm::vec3 heading,
                    float reachMetres) {
    glm::vec3 push =
        bordersAt(obstacles, position) + bordersAt(obstacles, position + heading * reachMetres);
    for (const Rock& rock : obstacles.rocks)
        push += ballPush(
            rock.centre, rock.radiusMetres + kRockClearanceMetres, position, heading, reachMetres);
    return push;
}

}  // namespace aquarama
