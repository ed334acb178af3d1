// SPDX-License-Identifier: Apache-2.0
// Food is eaten, hunger falls, and a school that feeds stays one.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

constexpr glm::vec3 kMiddle{0, -5.5F, -5};

WorldSpecies hungry(WorldSpecies species, double radiusMetres) {
    species.start = config::Start{.centre = kMiddle, .radiusMetres = radiusMetres, .hunger = 0.8};
    return species;
}

float hungerOf(const World& world, std::uint32_t fish) {
    return fish::innerHunger(world.speciesParameters()[world.view().kind[fish]],
                             world.minds()[fish]);
}

glm::vec3 middleOf(const World& world) {
    glm::vec3 sum{};
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        sum += world.view().position(fish);
    return sum / static_cast<float>(world.view().size());
}

float polarisation(const World& world) {
    glm::vec3 sum{};
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        sum += world.view().heading(fish);
    return place::lengthOf(sum) / static_cast<float>(world.view().size());
}

TEST(Eat, ASchoolEatsAPinchOfPelletsWithinAMinuteAndFormsAgain) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        WorldOptions options = openWater(seed, {hungry(scads(51), 1)});
        options.scene.gathering = config::Gathering::Journey;
        World world(options);
        for (int i = 0; i < 300; ++i) world.advance();
        world.apply(DropFood{middleOf(world) + glm::vec3{0.5F, 0.5F, 0}, 12});
        for (int i = 0; i < 3600; ++i) world.advance();
        EXPECT_EQ(world.counts().meals, 12U) << "seed " << seed;
        float best = 0;
        for (int i = 0; i < 1800; ++i) {
            world.advance();
            best = std::max(best, polarisation(world));
        }
        EXPECT_GT(best, 0.8F) << "seed " << seed;
    }
}

TEST(Eat, AMealIsInOneStomachAndHungerFalls) {
    World world(openWater(1, {hungry(scads(20), 0.6)}));
    world.apply(DropFood{kMiddle + glm::vec3{0.5F, 0, 0}, 60});
    float before = 0;
    for (std::uint32_t fish = 0; fish < 20; ++fish) before += hungerOf(world, fish);
    const auto eatenByEach = [&] {
        std::vector<std::uint16_t> eaten;
        for (std::uint32_t fish = 0; fish < 20; ++fish) eaten.push_back(world.minds()[fish].eaten);
        return eaten;
    };
    std::vector<std::uint16_t> eaten = eatenByEach();
    std::uint64_t fed = 0;
    std::uint64_t meals = 0;
    for (int i = 0; i < 1800; ++i) {
        world.advance();
        for (std::uint32_t fish = 0; fish < 20; ++fish)
            if (world.minds()[fish].eaten > eaten[fish]) {
                ++fed;
                EXPECT_LT(world.minds()[fish].sinceMeal, fish::kTicksBetweenThoughts);
            }
        eaten = eatenByEach();
        meals = world.counts().meals;
        ASSERT_EQ(fed, meals) << "two fish were fed by one particle, or none";
    }
    EXPECT_GT(meals, 20U);
    float after = 0;
    for (std::uint32_t fish = 0; fish < 20; ++fish) after += hungerOf(world, fish);
    EXPECT_LT(after, 0.6F * before);
}

TEST(Eat, AParticleIsDrawnIntoTheMouthInSightOfAll) {
    World world(openWater(1, {hungry(scads(1), 0.1)}));
    world.apply(DropFood{world.view().position(0) + glm::vec3{0.6F, 0, 0}, 12});
    const surroundings::Food& food = world.surroundings().food;
    const auto isTaken = [](std::uint8_t taken) { return taken != 0; };
    int taken = 0;
    for (int i = 0; i < 3600 && taken == 0; ++i) {
        world.advance();
        const auto one = std::ranges::find_if(food.taken, isTaken);
        if (one == food.taken.end()) continue;
        const auto particle = static_cast<std::size_t>(one - food.taken.begin());
        const auto fromMouth = [&] {
            return place::lengthOf(fish::mouthOf(world.view(), 0) - food.position(particle));
        };
        float before = fromMouth();
        EXPECT_LT(before, 0.4F * world.view().fish[0].length);
        while (food.taken[particle] != 0) {
            EXPECT_TRUE(food.isThere(particle));
            world.advance();
            if (food.taken[particle] == 0) break;
            EXPECT_LE(fromMouth(), before + 0.01F);
            before = fromMouth();
            ++taken;
        }
        EXPECT_FALSE(food.isThere(particle));
    }
    EXPECT_GE(taken, 3);
}

// Tangs on their own live on plankton.
TEST(Eat, ThoseWhoLiveAloneFindPlankton) {
    WorldOptions options = openWater(2, {hungry(pacifists(4), 1)});
    options.scene.plankton = 300;
    World world(options);
    for (int i = 0; i < 2 * 3600; ++i) world.advance();
    EXPECT_GE(world.counts().meals, 8U);
    for (std::uint32_t fish = 0; fish < 4; ++fish) EXPECT_LT(hungerOf(world, fish), 0.5F);
}

}  // namespace
}  // namespace aquarama::world
