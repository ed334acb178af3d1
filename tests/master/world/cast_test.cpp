// SPDX-License-Identifier: Apache-2.0
// A world of several species.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/captured_fish.h"
#include "tests/support/school_region.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kSchool = 51;
constexpr config::SizeRange kLarge{
    .meanMetres = 0.5F, .deviationMetres = 0.05F, .leastMetres = 0.4F, .mostMetres = 0.6F};

WorldOptions reef(unsigned threads) {
    WorldOptions options;
    options.threads = threads;
    WorldSpecies school{.tables = capturedTables("bigeye_scad"), .fish = kSchool};
    school.habits.shares.schooling = 1;
    WorldSpecies few{.tables = capturedTables("bigeye_scad"), .fish = 8};
    few.habits.role = config::Role::Pacifist;
    WorldSpecies one{.tables = capturedTables("bigeye_scad"), .fish = 1, .size = kLarge};
    one.habits.role = config::Role::Pacifist;
    options.cast = {school, few, one};
    return options;
}

TEST(Cast, fishStandInTheOrderOfTheirSpeciesAndAreAsLong) {
    const World world(reef(1));
    ASSERT_EQ(world.traits().size(), 60U);
    for (std::uint32_t fish = 0; fish < 60; ++fish) EXPECT_EQ(world.traits()[fish].id, fish);
    EXPECT_LT(world.traits()[58].lengthMillimetres, 300);
    EXPECT_GE(world.traits()[59].lengthMillimetres, 400);
}

TEST(Cast, isOneWorldOnAnyNumberOfThreads) {
    World one(reef(1));
    World two(reef(2));
    for (int i = 0; i < 600; ++i) {
        one.advance();
        two.advance();
    }
    EXPECT_EQ(one.hash(), two.hash());
}

TEST(Cast, thoseWhoKeepToThemselvesStayInTheWaterAndGoAbout) {
    WorldOptions options = reef(1);
    options.scene.plankton = 0;  // no food keeps them anywhere
    World world(options);
    const place::Region water = test::schoolRegion();
    for (std::size_t fish = kSchool; fish < 60; ++fish) EXPECT_GT(world.view().fish[fish].speed, 0);
    std::vector<float> west(60, 100.0F);
    std::vector<float> east(60, -100.0F);
    for (int i = 0; i < 5 * 60 * 60; ++i) {
        world.advance();
        for (std::size_t fish = kSchool; fish < 60; ++fish) {
            const glm::vec3 from = world.view().position(fish) - water.centre;
            const float margin = 0.7F + 0.5F * world.view().fish[fish].length;  // of a turn
            ASSERT_LT(std::abs(from.x), water.halfExtent.x + margin) << fish;
            ASSERT_LT(std::abs(from.y), water.halfExtent.y + margin) << fish;
            ASSERT_LT(std::abs(from.z), water.halfExtent.z + margin) << fish;
            west[fish] = std::min(west[fish], from.x);
            east[fish] = std::max(east[fish], from.x);
        }
    }
    for (std::size_t fish = kSchool; fish < 60; ++fish)
        EXPECT_GT(east[fish] - west[fish], 4.0F) << fish;
}

// Whatever else swims about, members of the school stay with others of it, also where it parts.
TEST(Cast, theSchoolFollowsNobodyElse) {
    WorldOptions options = reef(1);
    options.scene.plankton = 0;  // nor is there food to leave it for
    World world(options);
    std::vector<float> distances;
    for (int i = 0; i < 3 * 60 * 60; ++i) {
        world.advance();
        if (i % 60 != 0) continue;
        for (std::size_t fish = 0; fish < kSchool; ++fish) {
            float nearest = 99;
            for (std::size_t other = 0; other < kSchool; ++other)
                if (other != fish)
                    nearest = std::min(nearest,
                                       place::lengthOf(world.view().position(fish) -
                                                       world.view().position(other)));
            distances.push_back(nearest);
        }
    }
    std::ranges::sort(distances);
    EXPECT_LT(distances[distances.size() * 99 / 100], 1.2F) << "metres to the nearest";
    EXPECT_LT(distances.back(), 5.0F) << "nobody is led away";
}

}  // namespace
}  // namespace aquarama::world
