// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/presented.h"

#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace aquarama::show {
namespace {

motion::FishRecord recordAt(glm::vec3 metres) {
    motion::MotionStates states;
    states.resize(1);
    motion::setBodyFrame(states, 0, {.position = metres, .rotation = {1, 0, 0, 0}});
    return motion::recordOf(states, 0);
}

wire::StateFrame halfWay() {
    wire::StateFrame frame;
    frame.tick = {61};
    frame.fraction = 0.5F;
    frame.before = {recordAt({1, 2, 3}), recordAt({0, 0, 0})};
    frame.after = {recordAt({3, 2, 3}), recordAt({0, 1, 0})};
    return frame;
}

const std::vector<motion::FishTraits> kTwo{{.id = 4, .lengthMillimetres = 200},
                                           {.id = 9, .lengthMillimetres = 250}};

TEST(Presented, fishAreBetweenTheTicks) {
    const auto fish = presentedFish(halfWay(), kTwo);
    ASSERT_EQ(fish.size(), 2U);
    EXPECT_NEAR(glm::distance(fish[0].positionMetres, {2, 2, 3}), 0, 1e-4);
    EXPECT_EQ(fish[0].id, 4U);
    EXPECT_FLOAT_EQ(fish[1].lengthMetres, 0.25F);
}

TEST(Presented, withoutATickBeforeTheFrameIsTheTick) {
    wire::StateFrame frame = halfWay();
    frame.before.clear();
    EXPECT_NEAR(glm::distance(presentedFish(frame, kTwo)[0].positionMetres, {3, 2, 3}), 0, 1e-4);
}

TEST(Presented, recordsBeyondTheSchoolAreLeftOut) {
    EXPECT_EQ(presentedFish(halfWay(), std::span(kTwo).first(1)).size(), 1U);
}

wire::FoodRecord pelletAt(glm::vec3 place, unsigned generation) {
    return wire::foodRecord(wire::FoodRecord::Kind::Pellet, place, generation);
}

std::vector<scene::FoodParticle> foodOf(const wire::StateFrame& frame) {
    std::vector<scene::FoodParticle> food;
    presentFood(frame, food);
    return food;
}

TEST(Presented, foodIsBetweenTheTicks) {
    wire::StateFrame frame = halfWay();
    frame.foodOriginMetres = {0, -6, 0};
    frame.foodBefore = {{}, pelletAt({0, 1, 0}, 2)};
    frame.foodAfter = {{}, pelletAt({0, 2, 0}, 2)};
    const auto food = foodOf(frame);
    ASSERT_EQ(food.size(), 1U);
    EXPECT_NEAR(glm::distance(food[0].positionMetres, {0, -4.5F, 0}), 0, 1e-4);
    EXPECT_TRUE(food[0].isPellet);
    frame.foodBefore.clear();
    frame.fraction = 1.0F;
    EXPECT_NEAR(glm::distance(foodOf(frame)[0].positionMetres, {0, -4, 0}), 0, 1e-4);
}

// One is eaten here, another comes there in its place: nothing flies through the water.
TEST(Presented, aParticleNeverGlidesToTheOneThatTakesItsPlace) {
    wire::StateFrame frame = halfWay();
    frame.foodBefore = {pelletAt({0, 1, 0}, 1), pelletAt({5, 0, 0}, 1), {}};
    frame.foodAfter = {pelletAt({9, 9, 9}, 2),
                       {},
                       wire::foodRecord(wire::FoodRecord::Kind::Plankton, {3, 0, 0}, 0)};
    const auto food = foodOf(frame);
    ASSERT_EQ(food.size(), 2U);
    EXPECT_EQ(food[0].positionMetres, glm::vec3(9, 9, 9));
    EXPECT_EQ(food[1].positionMetres, glm::vec3(3, 0, 0));
    EXPECT_FALSE(food[1].isPellet);
    EXPECT_NE(food[0].seed, food[1].seed);
}

TEST(Presented, theClockRunsWithTheTicks) {
    EXPECT_DOUBLE_EQ(presentedSeconds(halfWay()), 60.5 / 60);
    wire::StateFrame first;
    EXPECT_DOUBLE_EQ(presentedSeconds(first), 0);
}

TEST(Presented, theEyeIsTheWallsSweetSpot) {
    // Turned left by a quarter: what is ahead on the wall is -X in the world.
    const wire::Eye eye{.positionMetres = {5, -6, 7},
                        .worldFromWall = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 1, 0))};
    const glm::dmat4 wall = wallFromWorld(eye);
    EXPECT_NEAR(glm::length(glm::dvec3(wall * glm::dvec4(5, -6, 7, 1))), 0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::dvec3(wall * glm::dvec4(3, -6, 7, 1)), {0, 0, -2}), 0, 1e-6);
}

}  // namespace
}  // namespace aquarama::show
