// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "master/behaviour/routines.h"
#include "tests/master/behaviour/aquarium.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama::behaviour {
namespace {

float right(const fish::Courses& courses, std::size_t fish) {
    return courses[fish].direction.z;  // heading +x, a fish has +z to its right
}

// In formation already, as a mind remembers and others see.
void fallIn(Aquarium& scene) {
    for (std::size_t fish = 0; fish < scene.view.size(); ++fish) {
        scene.minds[fish].intention = fish::Intention::School;
        scene.view.signs[fish] |= fish::kSchooling;
    }
}

TEST(SchoolRoutine, fishTooNearPartByASlant) {
    Aquarium scene({{0, 0, -0.04F}, {0, 0, 0.04F}});
    const fish::Courses wanted = scene.think();
    EXPECT_LT(right(wanted, 0), -0.25F);
    EXPECT_GT(right(wanted, 1), 0.25F);
    EXPECT_LT(right(wanted, 1) - right(wanted, 0), 1.2F) << "turned more, their tails would meet";
}

TEST(SchoolRoutine, fishFarApartDrawTogether) {
    Aquarium scene({{0, 0, -0.45F}, {0, 0, 0.45F}});
    const fish::Courses wanted = scene.think();
    EXPECT_GT(right(wanted, 0) - right(wanted, 1), 0.1F);
}

TEST(SchoolRoutine, aFishFallsInWithTheCourseOfItsNeighbours) {
    Aquarium scene({{0, 0, 0}, {0.2F, 0, -0.2F}, {0.2F, 0, 0.2F}});
    for (const std::size_t other : {1U, 2U}) {
        scene.head(other, {0.7071F, 0, 0.7071F});
    }
    fallIn(scene);
    EXPECT_GT(right(scene.think(), 0), 0.2F);
}

TEST(SchoolRoutine, oneBehindATailBrakes) {
    Aquarium scene({{0, 0, 0}, {0.23F, 0, 0}});
    const fish::Courses wanted = scene.think();
    EXPECT_LT(wanted[0].speed, wanted[1].speed - 0.3F);
}

TEST(SchoolRoutine, theFartherAFishFellBehindTheMoreItHurries) {
    const auto speedBehind = [](float metres) {
        Aquarium scene({{-metres, 0, 0}, {0, 0, 0}});
        return scene.think()[0].speed;
    };
    EXPECT_GT(speedBehind(1.2F), speedBehind(0.45F) + 0.3F);
}

TEST(SchoolRoutine, wantedDirectionsAreUnitVectorsOfModeratePitch) {
    Aquarium scene(std::vector<glm::vec3>(400));
    const fish::FishView strewn = scatteredSchool(5, 400, scene.surroundings.obstacles.water);
    for (std::size_t fish = 0; fish < 400; ++fish) {
        scene.put(fish, strewn.position(fish) - Aquarium::kCentre);
        scene.head(fish, strewn.heading(fish));
    }
    const fish::Courses wanted = scene.think();
    for (std::size_t fish = 0; fish < scene.view.size(); ++fish) {
        EXPECT_NEAR(place::lengthOf(wanted[fish].direction), 1, 1e-5F);
        EXPECT_LT(std::abs(wanted[fish].direction.y), 0.43F);
    }
}

TEST(SchoolRoutine, eachFishThinksOnceInEightTicksAndAnEighthOfThemAtATime) {
    for (std::uint64_t tick = 0; tick < 16; ++tick) {
        int thinking = 0;
        for (std::size_t fish = 0; fish < 800; ++fish)
            thinking += fish::thinksAt({tick}, fish) ? 1 : 0;
        EXPECT_EQ(thinking, 100);
    }
    for (std::size_t fish = 0; fish < 9; ++fish)
        EXPECT_EQ(fish::thinksAt({3}, fish), fish::thinksAt({11}, fish));
}

}  // namespace
}  // namespace aquarama::behaviour
