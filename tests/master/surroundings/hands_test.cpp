// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/hands.h"

#include <gtest/gtest.h>

#include "common/place/place.h"

namespace aquarama::surroundings {
namespace {

// One hand that goes along x at this speed for so long, seen thirty times a second.
HeldHand afterMoving(float metresPerSecond, float seconds, float restSeconds = 0) {
    HeldHands held = makeHands();
    Tick tick{100};
    float x = -1;
    const auto run = [&](float speed, float time) {
        for (float passed = 0; passed < time; passed += 1.0F / 30) {
            x += speed / 30;
            tick.value += 2;
            holdHands(held, {{7, {x, 0, -3}}}, tick);
        }
    };
    holdHands(held, {{7, {x, 0, -3}}}, tick);
    run(metresPerSecond, seconds);
    run(0, restSeconds);
    return held.hands.front();
}

TEST(Hands, areQuickOrStillByTheirSpeedOnTheScreen) {
    EXPECT_EQ(afterMoving(2, 0.2F).quick, 1);
    EXPECT_EQ(afterMoving(2, 0.2F).still, 0);
    EXPECT_EQ(afterMoving(0.4F, 1).quick, 0);
    EXPECT_EQ(afterMoving(0.4F, 1).still, 0) << "slow, but it moves";
    EXPECT_GT(afterMoving(0.85F, 1).quick, 0.3F);
    EXPECT_LT(afterMoving(0.85F, 1).quick, 0.7F);
    EXPECT_EQ(afterMoving(0.1F, 1.2F).still, 1) << "no hand holds quite still";
    EXPECT_GT(afterMoving(2, 0.2F, 0.5F).quick, 0.3F) << "it calms in a second";
    EXPECT_EQ(afterMoving(2, 0.2F, 1.2F).quick, 0);
    EXPECT_EQ(afterMoving(2, 0.2F, 1.2F).still, 1);
}

TEST(Hands, standBeforeTheSubmarineAsItTurns) {
    HeldHands held = makeHands();
    holdHands(held, {{1, {0, 0, -3}}, {2, {3, 0, 0}}}, {0});
    Vessel vessel;
    vessel.position = {10, -6, 4};
    placeHands(held, vessel, {1});
    EXPECT_NEAR(place::lengthOf(held.hands[0].direction - glm::vec3(0, 0, -1)), 0, 1e-6);
    EXPECT_NEAR(place::lengthOf(held.hands[1].direction - glm::vec3(1, 0, 0)), 0, 1e-6);
    EXPECT_LT(held.hands[0].place.z, vessel.position.z - 2);
    vessel.attitude.yaw = place::kPi / 2;  // to the left: it looks along -x
    placeHands(held, vessel, {2});
    EXPECT_NEAR(place::lengthOf(held.hands[0].direction - glm::vec3(-1, 0, 0)), 0, 1e-5);
    EXPECT_NEAR(place::lengthOf(held.hands[1].direction - glm::vec3(0, 0, -1)), 0, 1e-5);
}

TEST(Hands, goWhereTheirTrackerLosesThemOrFallsSilent) {
    HeldHands held = makeHands();
    holdHands(held, {{1, {0, 0, -3}}, {2, {3, 0, 0}}}, {0});
    holdHands(held, {{2, {3, 0, 0}}}, {2});
    ASSERT_EQ(held.hands.size(), 1U);
    EXPECT_EQ(held.hands[0].seen.id, 2U);
    placeHands(held, {}, {2 + kTicksOfAHand});
    EXPECT_EQ(held.hands.size(), 1U);
    placeHands(held, {}, {3 + kTicksOfAHand});
    EXPECT_TRUE(held.hands.empty());
    EXPECT_EQ(foldedHands(5, held), 5U) << "a world without hands has the hash that it had";
}

}  // namespace
}  // namespace aquarama::surroundings
