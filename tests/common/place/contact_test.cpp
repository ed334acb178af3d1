// SPDX-License-Identifier: Apache-2.0
// Contact in closed form: out of rock and sand by the depth, back into the water by the way.
#include "common/place/contact.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace aquarama::place {
namespace {

constexpr Region kWater{{0, -5.75F, -3.6F}, {7.4F, 2.45F, 6.1F}};
constexpr float kHalfWidth = 0.02F;
constexpr float kClear = kHalfWidth + 0.01F;

Obstacles reef() {
    return obstaclesOf({1, config::PlaceKind::Reef}, kWater);
}

float topOf(const Rock& rock) {
    return rock.centre.y + kDrawnRadii * rock.radiusMetres;
}

bool isInWater(const Rock& rock) {
    return std::abs(rock.centre.x - kWater.centre.x) < kWater.halfExtent.x &&
           std::abs(rock.centre.z - kWater.centre.z) < kWater.halfExtent.z;
}

// Over the crown of the highest rock in the water, so deep in what it touches.
glm::vec3 overCrown(const Obstacles& obstacles, float depthMetres) {
    const Rock& rock = *std::ranges::max_element(
        obstacles.rocks, {}, [](const Rock& one) { return isInWater(one) ? topOf(one) : -99; });
    return {rock.centre.x, topOf(rock) + kClear - depthMetres, rock.centre.z};
}

TEST(Contact, isNothingInOpenWater) {
    const Obstacles obstacles = reef();
    EXPECT_EQ(contactVelocity(obstacles, {0, -4, 0}, kHalfWidth), glm::vec3(0));
    EXPECT_EQ(contactVelocity(obstacles, overCrown(obstacles, -0.001F), kHalfWidth), glm::vec3(0));
}

TEST(Contact, pushesOutOfARockByTheDepth) {
    const Obstacles obstacles = reef();
    const glm::vec3 velocity = contactVelocity(obstacles, overCrown(obstacles, 0.01F), kHalfWidth);
    EXPECT_NEAR(velocity.x, 0, 1e-5F);
    EXPECT_NEAR(velocity.y, 0.4F, 1e-3F);
    EXPECT_NEAR(velocity.z, 0, 1e-5F);
    EXPECT_NEAR(contactVelocity(obstacles, overCrown(obstacles, 0.2F), kHalfWidth).y, 2, 1e-3F);
}

TEST(Contact, pushesOutOfTheSand) {
    const Obstacles obstacles = reef();
    const glm::vec2 xz{0, 1};
    const glm::vec3 place{xz.x, obstacles.chart.sand(xz) + kClear - 0.02F, xz.y};
    EXPECT_NEAR(contactVelocity(obstacles, place, kHalfWidth).y, 0.8F, 1e-3F);
}

TEST(Contact, bringsBackWhatLeftItsWater) {
    const Obstacles obstacles = reef();
    const float side = kWater.halfExtent.x;
    const auto along = [&](float x) {
        return contactVelocity(obstacles, {x, -4, -3}, kHalfWidth).x;
    };
    EXPECT_EQ(along(side + 0.29F), 0);
    EXPECT_NEAR(along(side + 0.4F), -0.05F, 1e-5F);
    EXPECT_NEAR(along(-side - 0.4F), 0.05F, 1e-5F);
    EXPECT_NEAR(along(side + 5), -0.1F, 1e-6F) << "off the chart too";
}

}  // namespace
}  // namespace aquarama::place
