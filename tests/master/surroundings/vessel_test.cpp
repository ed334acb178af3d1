// SPDX-License-Identifier: Apache-2.0
// The submarine in open water, against closed forms.
#include "master/surroundings/vessel.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace aquarama::surroundings {
namespace {

void push(Vessel& vessel, const Push& wanted, int ticks) {
    for (int i = 0; i < ticks; ++i) {
        pushVessel(vessel, wanted, kHandsSlew);
        vessel.position += vessel.velocity * kTickSeconds;
    }
}

TEST(Vessel, comesToItsTerminalSpeed) {
    const float fastest = terminalSpeed(kThrustNewtons);
    EXPECT_NEAR(fastest, 1.2F, 1e-5F);
    Vessel vessel;
    push(vessel, {.ahead = 1}, 60 * 30);
    EXPECT_NEAR(vessel.velocity.z, -fastest, 1e-4F);
    EXPECT_NEAR(vessel.velocity.x, 0, 1e-6F);
    Vessel rising;
    push(rising, {.up = 0.5F}, 60 * 30);
    EXPECT_NEAR(rising.velocity.y, terminalSpeed(0.5F * kSideThrustNewtons), 1e-4F);
    Vessel aside;
    push(aside, {.aside = -1}, 60 * 30);
    EXPECT_NEAR(aside.velocity.x, -terminalSpeed(kSideThrustNewtons), 1e-4F);
}

// Against linear and square drag together a body glides m/b ln(1 + b v/a) metres.
TEST(Vessel, glidesAsFarAsItsMomentumCarriesIt) {
    Vessel vessel;
    vessel.velocity = {0, 0, -1.2F};
    push(vessel, {}, 60 * 60);
    const double a = double{kDragNewtonsPerSpeed};
    const double b = double{kDragNewtonsPerSpeedSquared};
    const double metres = double{kVesselKilograms} / b * std::log1p(b * 1.2 / a);
    EXPECT_NEAR(metres, 2.3, 0.1);
    EXPECT_NEAR(-vessel.position.z, metres, 0.01 * metres);
    EXPECT_LT(place::lengthOf(vessel.velocity), 1e-6F);
}

TEST(Vessel, turnsAtItsFastestAndStopsTurning) {
    Vessel vessel;
    push(vessel, {.turn = 1}, 60 * 5);
    EXPECT_NEAR(vessel.rate.yaw, kFastestTurn, 1e-3F);
    push(vessel, {}, 60 * 5);
    EXPECT_NEAR(vessel.rate.yaw, 0, 1e-3F);
}

// Pitch never passes 25 degrees, however it is asked for, and rights itself; so does the bank.
TEST(Vessel, pitchIsLimitedAndTheHullRightsItself) {
    Vessel vessel;
    float steepest = 0;
    for (int i = 0; i < 60 * 20; ++i) {
        push(vessel, {.tilt = i % 600 < 300 ? 1.0F : -1.0F}, 1);
        steepest = std::max(steepest, std::abs(vessel.attitude.pitch));
    }
    EXPECT_LE(steepest, kSteepestPitch);
    EXPECT_GT(steepest, 0.9F * kSteepestPitch);
    push(vessel, {}, 60 * 10);
    EXPECT_NEAR(vessel.attitude.pitch, 0, 1e-3F);
    push(vessel, {.ahead = 1, .turn = 1}, 60 * 10);
    EXPECT_GT(vessel.attitude.roll, 0.5F * kStrongestBank) << "leans into a turn to the left";
    EXPECT_LE(vessel.attitude.roll, kStrongestBank);
    push(vessel, {}, 60 * 10);
    EXPECT_NEAR(vessel.attitude.roll, 0, 1e-3F);
}

TEST(Vessel, aHandsFullSteeringIsAFullPush) {
    const Push push = pushOf({kFullSteering, -kFullSteering, 0, 64, -128});
    EXPECT_EQ(push.ahead, 1);
    EXPECT_EQ(push.aside, -1);
    EXPECT_EQ(push.up, 0);
    EXPECT_NEAR(push.turn, 0.5F, 0.01F);
    EXPECT_EQ(push.tilt, -1);
}

}  // namespace
}  // namespace aquarama::surroundings
