// SPDX-License-Identifier: Apache-2.0
// What the chart says beside what is worked out.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/base/hash.h"
#include "common/place/obstacles.h"
#include "common/place/place.h"
#include "master/surroundings/avoidance.h"
#include "tests/support/school_region.h"

namespace aquarama::surroundings {
namespace {

constexpr int kPlaces = 20'000;

struct Probe {
    glm::vec3 position;
    glm::vec3 heading;
    float reachMetres;
};

// Within the water and a metre about it.
Probe probeIn(const place::Region& water, std::uint32_t index) {
    const std::uint32_t hash = hashOf(77, index);
    const auto draw = [&](std::uint32_t i) { return signedUnitOf(hashOf(hash, i)); };
    return {water.centre + (water.halfExtent + 1.0F) * glm::vec3{draw(0), draw(1), draw(2)},
            place::directionOf({draw(3), 0.4F * draw(4), draw(5)}, {1, 0, 0}),
            0.5F + 1.2F * std::abs(draw(6))};
}

TEST(Chart, knowsTheSandToHalfACentimetre) {
    const place::Region water = test::schoolRegion();
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const place::Chart chart({seed}, water, {});
        float worst = 0;
        for (std::uint32_t i = 0; i < kPlaces; ++i) {
            const glm::vec3 at = probeIn(water, i).position;
            ASSERT_TRUE(chart.covers({at.x, at.z}));
            const float sand = place::floorHeight({seed}, {at.x, at.z});
            worst = std::max(worst, std::abs(chart.sand({at.x, at.z}) - sand));
            EXPECT_LT(sand, chart.highestSand() + 0.005F);
        }
        EXPECT_LT(worst, 0.005F);
        EXPECT_GT(worst, 0.0F) << "it is not the noise itself";
    }
}

TEST(Chart, pushesAsWithoutIt) {
    // Deep enough that the sand pushes too, and wide enough for kelp.
    place::Region water = test::schoolRegion();
    water.halfExtent += glm::vec3{3, 1.2F, 1};
    const place::Obstacles obstacles = place::obstaclesOf({1}, water);
    ASSERT_GT(obstacles.rocks.size(), 5U);
    ASSERT_GT(obstacles.stems.size(), 0U);
    int pushed = 0;
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
        const Probe probe = probeIn(water, i);
        const glm::vec3 plain =
            plainAvoidance(obstacles, probe.position, probe.heading, probe.reachMetres);
        const glm::vec3 charted =
            avoidance(obstacles, probe.position, probe.heading, probe.reachMetres);
        ASSERT_LT(place::lengthOf(plain - charted), 0.1F) << i;
        pushed += place::lengthOf(plain) > 0 ? 1 : 0;
    }
    EXPECT_GT(pushed, kPlaces / 4);
    EXPECT_LT(pushed, kPlaces);
}

TEST(Chart, awayFromTheSandItPushesToTheBitAsWithoutIt) {
    const place::Obstacles obstacles = place::obstaclesOf({2}, test::schoolRegion());
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
        Probe probe = probeIn(obstacles.water, i);
        probe.position.y = std::max(probe.position.y, -6.0F);
        ASSERT_EQ(plainAvoidance(obstacles, probe.position, probe.heading, probe.reachMetres),
                  avoidance(obstacles, probe.position, probe.heading, probe.reachMetres))
            << i;
    }
}

TEST(Chart, offTheChartAndFartherThanItReachesThePlainWayServes) {
    const place::Obstacles obstacles = place::obstaclesOf({2}, test::schoolRegion());
    const glm::vec3 far = obstacles.water.centre + glm::vec3{40, 0, 0};
    EXPECT_EQ(avoidance(obstacles, far, {1, 0, 0}, 1),
              plainAvoidance(obstacles, far, {1, 0, 0}, 1));
    const glm::vec3 middle = obstacles.water.centre;
    EXPECT_EQ(avoidance(obstacles, middle, {1, 0, 0}, 8),
              plainAvoidance(obstacles, middle, {1, 0, 0}, 8));
}

TEST(Chart, theOpenSeaHasNothingInIt) {
    const place::Obstacles sea =
        place::obstaclesOf({1, config::PlaceKind::OpenSea}, test::schoolRegion());
    EXPECT_TRUE(sea.rocks.empty());
    EXPECT_TRUE(sea.stems.empty());
    EXPECT_EQ(avoidance(sea, sea.water.centre, {1, 0, 0}, 1), glm::vec3(0));
}

}  // namespace
}  // namespace aquarama::surroundings
