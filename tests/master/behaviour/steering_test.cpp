// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/steering.h"

#include <gtest/gtest.h>

#include "master/behaviour/angle.h"
#include "master/behaviour/perception.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama {
namespace {

// A few fish in open water that all head along +x, and what they want at the tick when they think.
struct Scene {
    explicit Scene(std::vector<glm::vec3> offsets) {
        view = scatteredSchool(1, offsets.size(), surroundings.water);
        for (std::size_t i = 0; i < offsets.size(); ++i) place(i, kCentre + offsets[i]);
    }
    void place(std::size_t fish, glm::vec3 position) {
        view.x[fish] = position.x;
        view.y[fish] = position.y;
        view.z[fish] = position.z;
        view.headingX[fish] = 1;
        view.headingY[fish] = view.headingZ[fish] = 0;
    }
    Intentions think() {
        Intentions intentions;
        intentions.resize(view.size());
        NeighbourGrid grid(surroundings.water, kCellMetres, view.size());
        grid.rebuild(view);
        for (std::uint64_t tick = 0; tick < kTicksBetweenThoughts; ++tick)
            Steering{&view, &grid, &surroundings, view.size(), goal, 0.5F, 1, {tick}, &intentions}
                .run(0, view.size());
        return intentions;
    }

    static constexpr glm::vec3 kCentre{0, -4, -5};
    Surroundings surroundings{3, {kCentre, {6, 3, 4}}, {}};
    Goal goal{kCentre, {0.4F, 0, 0}};
    SchoolView view;
};

float right(const Intentions& intentions, std::size_t fish) {
    return intentions.directionZ[fish];  // heading +x, a fish has +z to its right
}

TEST(Steering, fishTooNearPartByASlant) {
    Scene scene({{0, 0, -0.04F}, {0, 0, 0.04F}});
    const Intentions wanted = scene.think();
    EXPECT_LT(right(wanted, 0), -0.25F);
    EXPECT_GT(right(wanted, 1), 0.25F);
    EXPECT_LT(right(wanted, 1) - right(wanted, 0), 1.2F) << "turned more, their tails would meet";
}

TEST(Steering, fishFarApartDrawTogether) {
    Scene scene({{0, 0, -0.45F}, {0, 0, 0.45F}});
    const Intentions wanted = scene.think();
    EXPECT_GT(right(wanted, 0) - right(wanted, 1), 0.1F);
}

TEST(Steering, aFishFallsInWithTheCourseOfItsNeighbours) {
    Scene scene({{0, 0, 0}, {0.2F, 0, -0.2F}, {0.2F, 0, 0.2F}});
    for (const std::size_t other : {1U, 2U}) {
        scene.view.headingX[other] = 0.7071F;
        scene.view.headingZ[other] = 0.7071F;
    }
    EXPECT_GT(right(scene.think(), 0), 0.2F);
}

TEST(Steering, oneBehindATailBrakes) {
    Scene scene({{0, 0, 0}, {0.23F, 0, 0}});
    const Intentions wanted = scene.think();
    EXPECT_LT(wanted.speed[0], wanted.speed[1] - 0.3F);
}

TEST(Steering, aFishThatFellBehindHurriesAndOneAheadWaits) {
    Scene scene({{-1.5F, 0, 0}, {1.5F, 0, 0}});
    const Intentions wanted = scene.think();
    EXPECT_GT(wanted.speed[0], wanted.speed[1] + 0.5F);
}

TEST(Steering, wantedDirectionsAreUnitVectorsOfModeratePitch) {
    Scene scene({});
    scene.view = scatteredSchool(5, 400, scene.surroundings.water);
    const Intentions wanted = scene.think();
    for (std::size_t fish = 0; fish < scene.view.size(); ++fish) {
        EXPECT_NEAR(lengthOf(wanted.direction(fish)), 1, 1e-5F);
        EXPECT_LT(std::abs(wanted.directionY[fish]), 0.43F);
    }
}

TEST(Steering, eachFishThinksOnceInEightTicksAndAnEighthOfThemAtATime) {
    for (std::uint64_t tick = 0; tick < 16; ++tick) {
        int thinking = 0;
        for (std::size_t fish = 0; fish < 800; ++fish) thinking += thinksAt({tick}, fish) ? 1 : 0;
        EXPECT_EQ(thinking, 100);
    }
    for (std::size_t fish = 0; fish < 9; ++fish)
        EXPECT_EQ(thinksAt({3}, fish), thinksAt({11}, fish));
}

}  // namespace
}  // namespace aquarama
