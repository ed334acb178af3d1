// SPDX-License-Identifier: Apache-2.0
// How the fish of a scene stand at tick 0.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "tests/master/world/captured_fish.h"

namespace aquarama::world {
namespace {

WorldOptions schoolIn(config::PlaceKind place, std::uint32_t fish) {
    WorldOptions options = optionsOfSchool(3, fish);
    options.scene.place = place;
    options.scene.gathering = config::Gathering::None;
    options.scene.plankton = 0;
    return options;
}

bool isIn(const place::Region& water, glm::vec3 position) {
    const glm::vec3 out = glm::abs(position - water.centre) - water.halfExtent;
    return std::max({out.x, out.y, out.z}) <= 0;
}

TEST(Beginning, aSchoolOfAnySizeIsInItsWaterAndNoTwoAreInOnePlace) {
    for (const config::PlaceKind place : {config::PlaceKind::Reef, config::PlaceKind::OpenSea})
        for (const std::uint32_t fish : {1U, 51U, 20'000U}) {
            const World world(schoolIn(place, fish));
            std::vector<glm::vec3> places;
            for (std::size_t i = 0; i < fish; ++i) {
                places.push_back(motion::bodyFrameOf(world.states(), i).position);
                ASSERT_TRUE(isIn(world.surroundings().obstacles.water, places.back())) << i;
            }
            const auto before = [](glm::vec3 a, glm::vec3 b) {
                return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
            };
            std::ranges::sort(places, before);
            EXPECT_EQ(std::ranges::adjacent_find(places), places.end()) << fish;
        }
}

TEST(Beginning, aSchoolThatNothingGathersIsInTheMiddleOfTheScene) {
    const WorldOptions options = schoolIn(config::PlaceKind::OpenSea, 51);
    const World world(options);
    for (std::size_t i = 0; i < 51; ++i) {
        const glm::vec3 away =
            motion::bodyFrameOf(world.states(), i).position - options.scene.water.centre;
        EXPECT_LT(std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)}), 1);
    }
}

TEST(Beginning, fishWithAStartAreWhereItSays) {
    WorldOptions options = schoolIn(config::PlaceKind::OpenSea, 20);
    options.cast.front().start =
        config::Start{.centre = {2, -5, -6}, .radiusMetres = 0.5, .headingRadians = 1.5707963};
    const World world(options);
    for (std::size_t i = 0; i < 20; ++i) {
        const glm::vec3 away =
            motion::bodyFrameOf(world.states(), i).position - glm::vec3{2, -5, -6};
        EXPECT_LE(std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)}), 0.501F);
        EXPECT_LT(world.view().heading(i).z, -0.95F) << "away from the eye";
    }
}

TEST(Beginning, aSeaWithoutFishLives) {
    World world(schoolIn(config::PlaceKind::OpenSea, 0));
    for (int tick = 0; tick < 10; ++tick) world.advance();
    EXPECT_EQ(world.tick(), Tick{10});
}

}  // namespace
}  // namespace aquarama::world
