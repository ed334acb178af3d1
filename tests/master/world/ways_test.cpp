// SPDX-License-Identifier: Apache-2.0
// A school that nothing gathers goes from place to place by itself, and by no schedule.
#include "master/behaviour/ways.h"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {
namespace {

WorldOptions schoolOfTheReef(std::uint32_t seed) {
    WorldOptions options = optionsOfSchool(seed, 51);
    options.scene.gathering = config::Gathering::None;
    options.scene.plankton = 0;
    options.scene.water = {.centre = {0, -5.75F, -3.6F}, .halfExtent = {7.4F, 2.45F, 6.1F}};
    return options;
}

glm::vec3 middleOf(const World& world) {
    glm::vec3 sum{};
    for (std::uint32_t fish = 0; fish < 51; ++fish) sum += world.view().position(fish);
    return sum / 51.0F;
}

TEST(Ways, aboutOneFishInTwelveIsBold) {
    int bold = 0;
    for (std::uint32_t fish = 0; fish < 12'000; ++fish) bold += behaviour::isBold(1, fish) ? 1 : 0;
    EXPECT_NEAR(bold, 1000, 5 * 31);
}

TEST(Ways, theSchoolVisitsSeveralStructuresInTenMinutes) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        World world(schoolOfTheReef(seed));
        const auto& structures = world.surroundings().structures;
        std::set<std::size_t> visited;
        float way = 0;
        glm::vec3 last = middleOf(world);
        for (int second = 0; second < 600; ++second) {
            for (int i = 0; i < 60; ++i) world.advance();
            const glm::vec3 middle = middleOf(world);
            way += place::lengthOf(middle - last);
            last = middle;
            for (std::size_t i = 0; i < structures.size(); ++i) {
                const glm::vec3 from = structures[i].crown - middle;
                if (from.x * from.x + from.z * from.z < 2 * 2) visited.insert(i);
            }
        }
        EXPECT_GE(visited.size(), 3U) << "seed " << seed;
        EXPECT_GT(way, 30) << "metres of the middle, seed " << seed;
    }
}

// A place at which the school was tires it, and one that it never saw does not. Nothing frightens
// it here; where a fish is alarmed beside a structure, that one frightens, and is forgotten in
// minutes.
TEST(Ways, theSchoolRemembersWhereItWas) {
    World world(schoolOfTheReef(1));
    for (int i = 0; i < 120 * 60; ++i) world.advance();
    float most = 0;
    float least = 1;
    for (const surroundings::Structure& structure : world.surroundings().structures) {
        most = std::max(most, structure.tiredOf);
        least = std::min(least, structure.tiredOf);
        EXPECT_EQ(structure.fright, 0);
    }
    EXPECT_GT(most, 0.1F);
    EXPECT_LE(most, 1);
    EXPECT_LT(least, 0.5F * most);

    std::vector<surroundings::Structure> structures = world.surroundings().structures;
    fish::FishView view = world.view();
    for (fish::VisibleFish& fish : view.fish) fish.position = structures[0].crown;
    for (std::uint8_t& signs : view.signs) signs = fish::kSchooling | fish::kAlarmed;
    behaviour::Environment around = world.environment();
    around.view = &view;
    const auto remember = [&](int seconds) {
        for (int i = 0; i < seconds * 60; ++i, ++around.tick.value)
            behaviour::rememberPlaces(around, structures);
    };
    remember(1);
    EXPECT_NEAR(structures[0].fright, 1, 0.02F);
    for (std::uint8_t& signs : view.signs) signs = 0;
    remember(90);
    EXPECT_NEAR(structures[0].fright, 0.368F, 0.01F) << "1/e after 90 s";
}

TEST(Ways, theSchoolNeedsNoSubmarine) {
    WorldOptions options = schoolOfTheReef(1);
    World world(options);
    options.scene.eye = {0, -6, 30};
    World far(options);
    for (int i = 0; i < 120 * 60; ++i) {
        world.advance();
        far.advance();
    }
    EXPECT_GT(place::lengthOf(middleOf(far) - world.surroundings().obstacles.water.centre), 0.5F);
}

}  // namespace
}  // namespace aquarama::world
