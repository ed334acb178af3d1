// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/obstacles.h"

#include <algorithm>

#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

constexpr float kSideMarginMetres = 0.8F;     // where the push of an upright border begins
constexpr float kHeightMarginMetres = 0.45F;  // of the floor, the surface and the water's own
constexpr float kFloorClearanceMetres = 0.35F;
constexpr float kSurfaceClearanceMetres = 0.5F;
constexpr float kRockClearanceMetres = 0.3F;
constexpr float kRockMarginMetres = 0.6F;
constexpr float kStemRadiusMetres = 0.15F;  // of a kelp plant with its fronds
constexpr float kStemMarginMetres = 0.35F;
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

// Of the sides and heights that the water itself has; the surface too.
glm::vec3 bordersAt(const Obstacles& obstacles, glm::vec3 position) {
    const glm::vec3 from = position - obstacles.water.centre;
    const glm::vec3 half = obstacles.water.halfExtent;
    const float highest = -kSurfaceClearanceMetres - kHeightMarginMetres;
    return {borderPush(from.x, half.x, kSideMarginMetres),
            borderPush(from.y, half.y, kHeightMarginMetres) -
                ramp(position.y - highest, kHeightMarginMetres),
            borderPush(from.z, half.z, kSideMarginMetres)};
}

glm::vec3 sandPush(float sand, glm::vec3 position) {
    const float lowest = sand + kFloorClearanceMetres + kHeightMarginMetres;
    return {0, ramp(lowest - position.y, kHeightMarginMetres), 0};
}

float plainSand(const Obstacles& obstacles, glm::vec3 position) {
    return place::floorHeight(obstacles.place, {position.x, position.z});
}

// From something of a radius. What is near counts more than what the path meets later.
glm::vec3 pushAway(glm::vec3 away, float radius, float margin, float share) {
    const float felt = radius + margin;
    if (place::dot(away, away) >= felt * felt) return {};
    const float distance = place::lengthOf(away);
    return place::directionOf(away, {0, 1, 0}) *
           ((1 - 0.5F * share) * ramp(felt - distance, margin));
}

// A stem is passed in plan, below its top.
glm::vec3 stemPush(const Stem& stem, glm::vec3 position, glm::vec3 heading, float reachMetres) {
    if (position.y > stem.topMetres) return {};
    const glm::vec3 to{stem.foot.x - position.x, 0, stem.foot.y - position.z};
    const glm::vec3 level{heading.x, 0, heading.z};
    const float along = std::clamp(place::dot(to, level), 0.0F, reachMetres);
    const glm::vec3 away = level * along - to;
    return pushAway(away, kStemRadiusMetres, kStemMarginMetres, along / reachMetres);
}

glm::vec3 pushOf(const Obstacles& obstacles,
                 std::size_t index,
                 glm::vec3 position,
                 glm::vec3 heading,
                 float reachMetres) {
    const std::size_t rocks = obstacles.rocks.size();
    if (index >= rocks)
        return stemPush(obstacles.stems[index - rocks], position, heading, reachMetres);
    const place::Rock& rock = obstacles.rocks[index];
    return ballPush(
        rock.centre, rock.radiusMetres + kRockClearanceMetres, position, heading, reachMetres);
}

float distanceToWater(const place::Region& water, glm::vec3 point) {
    const glm::vec3 from = point - water.centre;
    const glm::vec3 nearest{std::clamp(from.x, -water.halfExtent.x, water.halfExtent.x),
                            std::clamp(from.y, -water.halfExtent.y, water.halfExtent.y),
                            std::clamp(from.z, -water.halfExtent.z, water.halfExtent.z)};
    return place::lengthOf(from - nearest);
}

std::vector<Stem> stemsIn(const place::PlaceKey& place, const place::Region& water) {
    std::vector<Stem> stems;
    for (const place::Plant& plant : place::plantsOf(place)) {
        const float top = plant.root.y + plant.heightMetres;
        const float height = std::clamp(water.centre.y, plant.root.y, top);
        const glm::vec3 nearest{plant.root.x, height, plant.root.z};
        if (plant.kind == place::PlantKind::Kelp &&
            distanceToWater(water, nearest) < kStemRadiusMetres + kStemMarginMetres)
            stems.push_back({{plant.root.x, plant.root.z}, top});
    }
    return stems;
}

Chart chartOf(const Obstacles& obstacles) {
    std::vector<Chart::Footprint> footprints;
    for (const place::Rock& rock : obstacles.rocks)
        footprints.push_back({{rock.centre.x, rock.centre.z},
                              rock.radiusMetres + kRockClearanceMetres + kRockMarginMetres});
    for (const Stem& stem : obstacles.stems)
        footprints.push_back({stem.foot, kStemRadiusMetres + kStemMarginMetres});
    return {obstacles.place, obstacles.water, footprints};
}

}  // namespace

glm::vec3 ballPush(
    glm::vec3 centre, float radius, glm::vec3 position, glm::vec3 heading, float reachMetres) {
    // Most rocks are low, and most fish swim well above them.
    const float lowest = position.y + std::min(0.0F, heading.y * reachMetres);
    if (lowest - centre.y >= radius + kRockMarginMetres) return {};
    const float along = std::clamp(place::dot(centre - position, heading), 0.0F, reachMetres);
    const glm::vec3 away = position + heading * along - centre;
    return pushAway(away, radius, kRockMarginMetres, along / reachMetres);
}

Obstacles obstaclesOf(const place::PlaceKey& place, const place::Region& water) {
    Obstacles obstacles{place, water, {}};
    for (const place::Rock& rock : place::rocksOf(place)) {
        const float reach = rock.radiusMetres + kRockClearanceMetres + kRockMarginMetres;
        if (distanceToWater(water, rock.centre) < reach) obstacles.rocks.push_back(rock);
    }
    obstacles.stems = stemsIn(place, water);
    obstacles.chart = chartOf(obstacles);
    return obstacles;
}

glm::vec3 plainAvoidance(const Obstacles& obstacles,
                         glm::vec3 position,
                         glm::vec3 heading,
                         float reachMetres) {
    const glm::vec3 ahead = position + heading * reachMetres;
    glm::vec3 push = bordersAt(obstacles, position) + bordersAt(obstacles, ahead) +
                     sandPush(plainSand(obstacles, position), position) +
                     sandPush(plainSand(obstacles, ahead), ahead);
    for (std::size_t i = 0; i < obstacles.rocks.size() + obstacles.stems.size(); ++i)
        push += pushOf(obstacles, i, position, heading, reachMetres);
    return push;
}

glm::vec3 avoidance(const Obstacles& obstacles,
                    glm::vec3 position,
                    glm::vec3 heading,
                    float reachMetres) {
    const Chart& chart = obstacles.chart;
    const glm::vec3 ahead = position + heading * reachMetres;
    const glm::vec2 here{position.x, position.z};
    const glm::vec2 there{ahead.x, ahead.z};
    if (reachMetres > kChartReachMetres || !chart.covers(here) || !chart.covers(there))
        return plainAvoidance(obstacles, position, heading, reachMetres);
    glm::vec3 push = bordersAt(obstacles, position) + bordersAt(obstacles, ahead);
    // In open water no sand is near.
    if (std::min(position.y, ahead.y) <
        chart.highestSand() + kFloorClearanceMetres + kHeightMarginMetres)
        push += sandPush(chart.sand(here), position) + sandPush(chart.sand(there), ahead);
    for (const std::uint32_t index : chart.near(here))
        push += pushOf(obstacles, index, position, heading, reachMetres);
    return push;
}

}  // namespace aquarama::surroundings
