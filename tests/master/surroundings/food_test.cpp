// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/food.h"

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/support/school_region.h"

namespace aquarama::surroundings {
namespace {

constexpr std::uint32_t kSeed = 5;
constexpr std::uint32_t kPlankton = 300;

place::Obstacles reef() {
    return place::obstaclesOf({kSeed}, test::schoolRegion());
}

void drift(Food& food, const place::Obstacles& obstacles, Tick& tick, int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick.value) driftFood(food, kSeed, obstacles, {}, tick);
}

TEST(Food, planktonDriftsAndStaysInTheWaterAndOffTheSandForTenMinutes) {
    const place::Obstacles obstacles = reef();
    Food food = makeFood(kSeed, obstacles, kPlankton);
    const Food before = food;
    Tick tick;
    float farthest = 0;
    for (int minute = 0; minute < 10; ++minute) {
        drift(food, obstacles, tick, 3600);
        for (std::uint32_t i = 0; i < kPlankton; ++i) {
            const glm::vec3 from = food.position(i) - obstacles.water.centre;
            EXPECT_LT(std::abs(from.x), obstacles.water.halfExtent.x);
            EXPECT_LT(std::abs(from.z), obstacles.water.halfExtent.z);
            EXPECT_LT(food.y[i], 0);
            EXPECT_GT(food.y[i], place::floorHeight({kSeed}, {food.x[i], food.z[i]}) + 0.5F);
            if (minute == 0)
                farthest =
                    std::max(farthest, place::lengthOf(food.position(i) - before.position(i)));
        }
    }
    EXPECT_GT(farthest, 0.3F);
}

TEST(Food, theSwellNeverJumps) {
    const place::Region water = test::schoolRegion();
    const glm::vec3 place = water.centre + water.halfExtent * 0.3F;
    for (std::uint64_t tick = 0; tick < 30'000; ++tick) {
        const glm::vec3 change = swellAt(water, place, {tick + 1}) - swellAt(water, place, {tick});
        ASSERT_LT(place::lengthOf(change), 0.0005F) << "tick " << tick;
    }
}

TEST(Food, ofTwoWhoWantAParticleOneHasIt) {
    Food food = makeFood(kSeed, reef(), kPlankton);
    EXPECT_TRUE(takeFood(food, 7));
    EXPECT_FALSE(takeFood(food, 7));
    EXPECT_TRUE(food.isThere(7)) << "until it is swallowed";
    EXPECT_FALSE(food.isFree(7));
    removeFood(food, 7, {});
    EXPECT_FALSE(food.isThere(7));
    EXPECT_FALSE(takeFood(food, 7));
    EXPECT_FALSE(takeFood(food, 1'000'000)) << "no such particle";
}

TEST(Food, eatenPlanktonComesBackElsewhere) {
    const place::Obstacles obstacles = reef();
    Food food = makeFood(kSeed, obstacles, kPlankton);
    const glm::vec3 before = food.position(7);
    const int generation = food.generation[7];
    Tick tick;
    ASSERT_TRUE(takeFood(food, 7));
    removeFood(food, 7, tick);
    drift(food, obstacles, tick, 20 * 60);
    EXPECT_FALSE(food.isThere(7)) << "not at once";
    drift(food, obstacles, tick, 25 * 60);
    ASSERT_TRUE(food.isFree(7));
    EXPECT_EQ(food.generation[7], generation + 1);
    EXPECT_GT(place::lengthOf(food.position(7) - before), 0.3F);
}

TEST(Food, pelletsSinkToTheSandLieThereAndDissolve) {
    const place::Obstacles obstacles = reef();
    Food food = makeFood(kSeed, obstacles, 0);
    Tick tick;
    const glm::vec3 place = test::schoolRegion().centre;
    dropPellets(food, kSeed, obstacles, place, 12, tick);
    EXPECT_EQ(food.pellets, 12U);
    EXPECT_LT(place::lengthOf(food.position(0) - place), 0.6F);
    const float sand = place::floorHeight({kSeed}, {food.x[0], food.z[0]});
    const int sinks = static_cast<int>((food.y[0] - sand) / 0.05F * 60);
    drift(food, obstacles, tick, sinks + 60);
    EXPECT_TRUE(food.isThere(0));
    EXPECT_FALSE(food.isFree(0)) << "no fish can pick it off the sand";
    EXPECT_NEAR(food.y[0], sand, 0.05F);
    drift(food, obstacles, tick, 60 * 60);
    EXPECT_EQ(food.pellets, 0U);
    for (std::size_t i = 0; i < food.size(); ++i) EXPECT_FALSE(food.isThere(i));
}

TEST(Food, pelletsThatSinkIntoTheDeepDissolveWhereNoFishGoes) {
    const place::Region water = test::schoolRegion();
    const place::Obstacles sea = place::obstaclesOf({kSeed, config::PlaceKind::OpenSea}, water);
    Food food = makeFood(kSeed, sea, 0);
    Tick tick;
    dropPellets(food, kSeed, sea, water.centre, 12, tick);
    while (food.pellets > 0) {
        for (std::size_t i = 0; i < 12; ++i)
            if (food.isThere(i)) {
                ASSERT_GT(food.y[i], water.centre.y - water.halfExtent.y - 0.01F);
            }
        drift(food, sea, tick, 60);
        ASSERT_LT(tick.value, 120U * 60);
    }
}

TEST(Food, thereIsRoomForSoManyPellets) {
    Food food = makeFood(kSeed, reef(), 10);
    dropPellets(food, kSeed, reef(), test::schoolRegion().centre, 100'000, {});
    EXPECT_EQ(food.pellets, kMostPellets);
    EXPECT_EQ(food.size(), 10 + kMostPellets);
}

}  // namespace
}  // namespace aquarama::surroundings
