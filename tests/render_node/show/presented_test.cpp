// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/presented.h"

#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace aquarama {
namespace {

FishRecord recordAt(glm::vec3 metres) {
    MotionStates states;
    states.resize(1);
    setBodyFrame(states, 0, {.position = metres, .rotation = {1, 0, 0, 0}});
    return recordOf(states, 0);
}

StateFrame halfWay() {
    StateFrame frame;
    frame.tick = {61};
    frame.fraction = 0.5F;
    frame.before = {recordAt({1, 2, 3}), recordAt({0, 0, 0})};
    frame.after = {recordAt({3, 2, 3}), recordAt({0, 1, 0})};
    return frame;
}

const std::vector<FishTraits> kTwo{{.id = 4, .lengthMillimetres = 200},
                                   {.id = 9, .lengthMillimetres = 250}};

TEST(Presented, fishAreBetweenTheTicks) {
    const auto fish = presentedFish(halfWay(), kTwo);
    ASSERT_EQ(fish.size(), 2U);
    EXPECT_NEAR(glm::distance(fish[0].positionMetres, {2, 2, 3}), 0, 1e-4);
    EXPECT_EQ(fish[0].id, 4U);
    EXPECT_FLOAT_EQ(fish[1].lengthMetres, 0.25F);
}

TEST(Presented, withoutATickBeforeTheFrameIsTheTick) {
    StateFrame frame = halfWay();
    frame.before.clear();
    EXPECT_NEAR(glm::distance(presentedFish(frame, kTwo)[0].positionMetres, {3, 2, 3}), 0, 1e-4);
}

TEST(Presented, recordsBeyondTheSchoolAreLeftOut) {
    EXPECT_EQ(presentedFish(halfWay(), std::span(kTwo).first(1)).size(), 1U);
}

TEST(Presented, theClockRunsWithTheTicks) {
    EXPECT_DOUBLE_EQ(presentedSeconds(halfWay()), 60.5 / 60);
    StateFrame first;
    EXPECT_DOUBLE_EQ(presentedSeconds(first), 0);
}

TEST(Presented, theEyeIsTheWallsSweetSpot) {
    // Turned left by a quarter: what is ahead on the wall is -X in the world.
    const Eye eye{.positionMetres = {5, -6, 7},
                  .worldFromWall = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 1, 0))};
    const glm::dmat4 wall = wallFromWorld(eye);
    EXPECT_NEAR(glm::length(glm::dvec3(wall * glm::dvec4(5, -6, 7, 1))), 0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::dvec3(wall * glm::dvec4(3, -6, 7, 1)), {0, 0, -2}), 0, 1e-6);
}

}  // namespace
}  // namespace aquarama
