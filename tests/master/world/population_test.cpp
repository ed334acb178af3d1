// SPDX-License-Identifier: Apache-2.0
// A sea lives on: nobody dies out, nothing gathers in one corner. Half an hour; with AQUARAMA_SOAK
// in the environment a day.
#include <cstdlib>
#include <iostream>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/fish/minds.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

int minutes() {
    return std::getenv("AQUARAMA_SOAK") == nullptr ? 30 : 24 * 60;
}

constexpr std::uint32_t kPopulationScads = 40, kPopulationTangs = 6;

WorldOptions livingSea() {
    WorldSpecies hunter = sharks(1);
    hunter.habits.hunts.emplace_back("blue_tang");
    WorldSpecies prey = scads(kPopulationScads);
    prey.habits.fear.metres = 0.8F;  // in so little water farther sight would be endless fear
    WorldOptions options = openWater(4, {prey, pacifists(kPopulationTangs), hunter});
    options.scene.gathering = config::Gathering::None;
    options.scene.plankton = 300;
    options.scene.eye = place::kEyePosition;
    return options;
}

std::uint64_t away(const World& world) {
    std::uint64_t count = 0;
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        count += static_cast<std::uint64_t>(motion::isAway(world.states(), fish));
    return count;
}

// Fish in each eighth of the water.
void countOctants(const World& world, std::array<int, 8>& octants) {
    const place::Region& water = world.surroundings().obstacles.water;
    for (std::size_t fish = 0; fish < world.view().size(); ++fish) {
        if (motion::isAway(world.states(), fish)) continue;
        const glm::vec3 from = world.view().position(fish) - water.centre;
        ++octants[static_cast<std::size_t>((from.x > 0 ? 1 : 0) + (from.y > 0 ? 2 : 0) +
                                           (from.z > 0 ? 4 : 0))];
    }
}

TEST(Population, isStable) {
    World world(livingSea());
    std::array<int, 8> octants{};
    float mostHungry = 0;
    for (int minute = 0; minute < minutes(); ++minute) {
        for (int i = 0; i < 3600; ++i) world.advance();
        ASSERT_EQ(away(world), world.counts().catches - world.counts().returns);
        ASSERT_LE(away(world), 8U) << "minute " << minute;
        countOctants(world, octants);
        if (minute < 10) continue;
        float hunger = 0;
        for (std::uint32_t fish = 0; fish < kPopulationScads + kPopulationTangs; ++fish)
            hunger += fish::innerHunger(world.speciesParameters()[world.view().kind[fish]],
                                        world.minds()[fish]);
        mostHungry = std::max(mostHungry, hunger / (kPopulationScads + kPopulationTangs));
    }
    const WorldCounts& counts = world.counts();
    std::cout << minutes() << " minutes: " << counts.meals << " meals, " << counts.catches
              << " catches, " << counts.returns << " returns, " << counts.spawnings
              << " spawnings; mean hunger at most " << mostHungry << "; shares of the octants";
    int all = 0;
    for (const int count : octants) all += count;
    for (const int count : octants) {
        const double share = static_cast<double>(count) / all;
        std::cout << ' ' << share;
        EXPECT_LT(share, 0.4) << "gathered in one corner";
    }
    std::cout << '\n';
    EXPECT_GT(counts.meals, static_cast<std::uint64_t>(minutes()));
    EXPECT_GT(counts.catches, 0U);
    EXPECT_GT(counts.spawnings, 0U);
    EXPECT_LT(mostHungry, 0.7F) << "there is food enough";
}

}  // namespace
}  // namespace aquarama::world
