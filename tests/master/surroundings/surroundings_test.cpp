// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/surroundings.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace aquarama::surroundings {
namespace {

config::Scene seaWithDrops() {
    config::Scene scene;
    scene.place = config::PlaceKind::OpenSea;
    scene.plankton = 5;
    scene.drops = {{.atSeconds = 1, .position = {0, -5, -5}, .pellets = 12},
                   {.atSeconds = 1, .position = {2, -5, -5}, .pellets = 3},
                   {.atSeconds = 2.5, .position = {0, -5, -5}, .pellets = 4}};
    return scene;
}

long pelletsIn(const Surroundings& surroundings) {
    return std::ranges::count(surroundings.food.kind, FoodKind::Pellet);
}

TEST(Surroundings, ofASceneAreItsOwn) {
    const config::Scene scene = seaWithDrops();
    const Surroundings sea = makeSurroundings(scene, 3, 60, 0.24F);
    EXPECT_EQ(sea.submarine.position, scene.eye);
    EXPECT_EQ(sea.obstacles.water.halfExtent, scene.water.halfExtent);
    EXPECT_EQ(sea.obstacles.place.kind, config::PlaceKind::OpenSea);
    EXPECT_TRUE(sea.obstacles.rocks.empty());
}

TEST(Surroundings, foodOfTheSceneFallsInAtItsTimes) {
    Surroundings sea = makeSurroundings(seaWithDrops(), 3, 60, 0.24F);
    auto passTo = [&, tick = std::uint64_t{0}](std::uint64_t end) mutable {
        for (; tick <= end; ++tick) advanceSurroundings(sea, {tick});
        return pelletsIn(sea);
    };
    EXPECT_EQ(passTo(59), 0);
    EXPECT_EQ(passTo(60), 15);
    EXPECT_EQ(passTo(149), 15);
    EXPECT_EQ(passTo(150), 19);
}

}  // namespace
}  // namespace aquarama::surroundings
