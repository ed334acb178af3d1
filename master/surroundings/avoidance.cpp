// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/avoidance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

// A push begins at the margin before a limit and is 1.5 at the limit. The limit lies the clearance
// away from the obstacle itself.
// Margin of an upright border of the water.
constexpr float kSideMarginMetres = 0.8F;
// Margin of the surface and of the lower and upper border of the water.
constexpr float kHeightMarginMetres = 0.45F;
constexpr float kSurfaceClearanceMetres = 0.5F;
// The widest berth: the chart lists by it.
constexpr Berth kWidest{};
static_assert(kWidest.rockClearance + kWidest.rockMargin <= place::kRockReachMetres);
// Beside a kelp plant.
constexpr float kStemMarginMetres = 0.35F;
static_assert(place::kStemRadiusMetres + kStemMarginMetres <= place::kStemReachMetres);
// No single push is stronger.
constexpr float kStrongest = 6.0F;

// Strength of a push: 0 where the margin begins, 1.5 at the limit, growing with the square.
float ramp(float beyondMarginMetres, float marginMetres) {
    if (beyondMarginMetres <= 0) return 0;
    const float share = beyondMarginMetres / marginMetres;
    return std::min(1.5F * share * share, kStrongest);
}

// Push of the two borders across one axis, towards the middle.
float borderPush(float fromCentre, float halfExtent, float margin) {
    const float inner = halfExtent - margin;
    return fromCentre > 0 ? -ramp(fromCentre - inner, margin) : ramp(-fromCentre - inner, margin);
}

// Push of the borders of the water and of the surface.
glm::vec3 bordersAt(const place::Obstacles& obstacles, glm::vec3 position) {
    const glm::vec3 from = position - obstacles.water.centre;
    const glm::vec3 half = obstacles.water.halfExtent;
    const float highest = -kSurfaceClearanceMetres - kHeightMarginMetres;
    return {borderPush(from.x, half.x, kSideMarginMetres),
            borderPush(from.y, half.y, kHeightMarginMetres) -
                ramp(position.y - highest, kHeightMarginMetres),
            borderPush(from.z, half.z, kSideMarginMetres)};
}

// Straight up, by the height over the sand.
glm::vec3 sandPush(float sand, glm::vec3 position, const Berth& berth) {
    const float lowest = sand + berth.sandClearance + berth.sandMargin;
    return {0, ramp(lowest - position.y, berth.sandMargin), 0};
}

float plainSand(const place::Obstacles& obstacles, glm::vec3 position) {
    return place::floorHeight(obstacles.place, {position.x, position.z});
}

// Push of a round obstacle; `away` leads from its middle to the path's nearest point. `share` says
// how far along the path that is, 0 to 1: what is near counts more.
glm::vec3 pushAway(glm::vec3 away, float radius, float margin, float share) {
    const float felt = radius + margin;
    if (place::dot(away, away) >= felt * felt) return {};
    const float distance = place::lengthOf(away);
    return place::directionOf(away, {0, 1, 0}) *
           ((1 - 0.5F * share) * ramp(felt - distance, margin));
}

// Push of a stem. Only the distance in plan counts, and only below the top of the stem.
glm::vec3 stemPush(const place::Stem& stem,
                   glm::vec3 position,
                   glm::vec3 heading,
                   float reachMetres) {
    if (position.y > stem.topMetres) return {};
    const glm::vec3 to{stem.foot.x - position.x, 0, stem.foot.y - position.z};
    const glm::vec3 level{heading.x, 0, heading.z};
    const float along = std::clamp(place::dot(to, level), 0.0F, reachMetres);
    const glm::vec3 away = level * along - to;
    return pushAway(away, place::kStemRadiusMetres, kStemMarginMetres, along / reachMetres);
}

// Push of obstacle `index` as the chart numbers them: rocks, then stems.
glm::vec3 pushOf(const place::Obstacles& obstacles,
                 std::size_t index,
                 glm::vec3 position,
                 glm::vec3 heading,
                 float reachMetres,
                 const Berth& berth) {
    const std::size_t rocks = obstacles.rocks.size();
    if (index >= rocks)
        return stemPush(obstacles.stems[index - rocks], position, heading, reachMetres);
    const place::Rock& rock = obstacles.rocks[index];
    return ballPush(rock.centre,
                    rock.radiusMetres + berth.rockClearance,
                    berth.rockMargin,
                    position,
                    heading,
                    reachMetres);
}

}  // namespace

Berth berthOf(float lengthMetres) {
    return {std::min(kWidest.rockClearance, 1.25F * lengthMetres),
            std::min(kWidest.rockMargin, 2.5F * lengthMetres),
            std::min(kWidest.sandClearance, 1.5F * lengthMetres),
            std::min(kWidest.sandMargin, 2 * lengthMetres)};
}

glm::vec3 ballPush(glm::vec3 centre,
                   float radius,
                   float marginMetres,
                   glm::vec3 position,
                   glm::vec3 heading,
                   float reachMetres) {
    // Quick test: most rocks are low, and most fish swim well above them.
    const float lowest = position.y + std::min(0.0F, heading.y * reachMetres);
    if (lowest - centre.y >= radius + marginMetres) return {};
    const float along = std::clamp(place::dot(centre - position, heading), 0.0F, reachMetres);
    const glm::vec3 away = position + heading * along - centre;
    return pushAway(away, radius, marginMetres, along / reachMetres);
}

float groundAt(const place::Obstacles& obstacles, glm::vec2 xz) {
    float ground = obstacles.chart.covers(xz) ? obstacles.chart.sand(xz)
                                              : plainSand(obstacles, {xz.x, 0, xz.y});
    const auto rises = [&](const place::Rock& rock) {
        const glm::vec2 from{xz.x - rock.centre.x, xz.y - rock.centre.z};
        const float within =
            rock.radiusMetres * rock.radiusMetres - from.x * from.x - from.y * from.y;
        if (within > 0) ground = std::max(ground, rock.centre.y + std::sqrt(within));
        return false;  // the others may rise higher
    };
    (void)place::anyRockNear(obstacles, xz, ground, rises);
    return ground;
}

glm::vec3 plainAvoidance(const place::Obstacles& obstacles,
                         glm::vec3 position,
                         glm::vec3 heading,
                         float reachMetres,
                         const Berth& berth) {
    assert(reachMetres > 0);
    const glm::vec3 ahead = position + heading * reachMetres;
    glm::vec3 push = bordersAt(obstacles, position) + bordersAt(obstacles, ahead) +
                     sandPush(plainSand(obstacles, position), position, berth) +
                     sandPush(plainSand(obstacles, ahead), ahead, berth);
    for (std::size_t i = 0; i < obstacles.rocks.size() + obstacles.stems.size(); ++i)
        push += pushOf(obstacles, i, position, heading, reachMetres, berth);
    return push;
}

glm::vec3 avoidance(const place::Obstacles& obstacles,
                    glm::vec3 position,
                    glm::vec3 heading,
                    float reachMetres,
                    const Berth& berth) {
    assert(reachMetres > 0);
    const place::Chart& chart = obstacles.chart;
    const glm::vec3 ahead = position + heading * reachMetres;
    const glm::vec2 here{position.x, position.z};
    const glm::vec2 there{ahead.x, ahead.z};
    // The chart lists what is within its reach of the position, and knows the sand only where it
    // covers both ends.
    if (reachMetres > place::kChartReachMetres || !chart.covers(here) || !chart.covers(there))
        return plainAvoidance(obstacles, position, heading, reachMetres, berth);
    glm::vec3 push = bordersAt(obstacles, position) + bordersAt(obstacles, ahead);
    // Skips the sand where even the highest sand is too low to push.
    if (std::min(position.y, ahead.y) <
        chart.highestSand() + berth.sandClearance + berth.sandMargin)
        push +=
            sandPush(chart.sand(here), position, berth) + sandPush(chart.sand(there), ahead, berth);
    for (const std::uint32_t index : chart.near(here))
        push += pushOf(obstacles, index, position, heading, reachMetres, berth);
    return push;
}

}  // namespace aquarama::surroundings
