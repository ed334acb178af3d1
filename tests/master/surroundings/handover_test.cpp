// SPDX-License-Identifier: Apache-2.0
// Between hand and autopilot nothing jumps.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/surroundings/pilot.h"
#include "tests/master/surroundings/voyages.h"

namespace aquarama::surroundings {
namespace {

// The largest changes in a tick, a second: of speed, of the rates of yaw, pitch and roll.
struct Jerks {
    float speed = 0, yaw = 0, pitch = 0, roll = 0;

    void add(const Vessel& before, const Vessel& after) {
        const auto most = [](float& so, float now) { so = std::max(so, std::abs(now) * 60); };
        most(speed, place::lengthOf(after.velocity - before.velocity));
        most(yaw, after.rate.yaw - before.rate.yaw);
        most(pitch, after.rate.pitch - before.rate.pitch);
        most(roll, after.rate.roll - before.rate.roll);
    }
};

class HandOver : public testing::Test {
  protected:
    void advance(std::uint64_t ticks, Jerks* jerks = nullptr) {
        for (std::uint64_t i = 0; i < ticks; ++i, ++now_.value) {
            const Vessel before = pilot_.vessel;
            advancePilot(pilot_, voyage_, {1, -6, -5}, now_);
            if (jerks != nullptr) jerks->add(before, pilot_.vessel);
        }
    }
    void hold(const Steering& steering, int ticks, Jerks* jerks = nullptr) {
        for (int i = 0; i < ticks; ++i) {
            steer(pilot_, voyage_, steering, now_);
            advance(1, jerks);
        }
    }
    // What thrusters and springs can do at most from a still push; nothing else may act.
    static void expectGentle(const Jerks& jerks) {
        EXPECT_LT(jerks.speed, 1.2F);
        EXPECT_LT(jerks.yaw, kTurnDamping * kFastestTurn * 2.01F);
        EXPECT_LT(jerks.pitch, 0.8F);
        EXPECT_LT(jerks.roll, 0.4F);
    }

    config::Scene scene_ = shippedScene("reef");
    Voyage voyage_ = voyageIn(scene_);
    Pilot pilot_ = pilotOf(voyage_, scene_.eye);
    Tick now_;
};

TEST_F(HandOver, theAutopilotTakesOverWithoutAJerk) {
    hold({.ahead = 127, .turn = -127, .tilt = 100}, 300);
    Jerks jerks;
    advance(voyage_.idleTicks, &jerks);
    EXPECT_FALSE(pilot_.touring);
    advance(kTicksOfAHand + 1, &jerks);
    EXPECT_TRUE(pilot_.touring);
    Jerks touring;
    advance(60 * 60, &touring);
    expectGentle(jerks);
    EXPECT_LT(touring.speed, 0.3F) << "alone it is gentler still";
    EXPECT_LT(touring.yaw * 180 / place::kPi, 6);
}

TEST_F(HandOver, aHandTakesOverWithoutAJerk) {
    advance(voyage_.idleTicks + 60 * 20);
    ASSERT_TRUE(pilot_.touring);
    ASSERT_GT(place::lengthOf(pilot_.vessel.velocity), 0.2F);
    Jerks jerks;
    hold({.ahead = -127, .aside = 127, .up = 127, .turn = 127, .tilt = -127}, 200, &jerks);
    EXPECT_FALSE(pilot_.touring);
    expectGentle(jerks);
}

// Full astern at full speed is the hardest that a hand can do: thrust and drag on the same side.
TEST_F(HandOver, theChangeIsNeverMoreThanThrustersCanGive) {
    Jerks jerks;
    for (std::uint32_t i = 0; i < 40; ++i) {
        hold(whim(3, 45 * i), 20, &jerks);
        advance(i % 8 == 7 ? voyage_.idleTicks + 200 : 40, &jerks);
    }
    EXPECT_LT(jerks.yaw, kTurnDamping * kFastestTurn * 2.01F);
    EXPECT_LT(jerks.pitch, 1.5F);
}

TEST_F(HandOver, theAutopilotFindsBackToItsTourFromAnywhere) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        for (std::uint32_t i = 0; i < 60; ++i) hold(whim(seed, 45 * i), 45);
        advance(voyage_.idleTicks + 60 * 90);
        const glm::vec3 path = pointOf(voyage_.tour, pilot_.along, {}).at;
        EXPECT_LT(place::lengthOf(path - pilot_.vessel.position), 1.0F) << seed;
        EXPECT_GT(place::lengthOf(pilot_.vessel.velocity), 0.1F) << seed << ": it goes on";
    }
}

TEST(Home, withoutATourItComesBackToTheEyeAndLooksAhead) {
    const config::Scene scene = shippedScene("routines/school");
    const Voyage voyage = voyageIn(scene);
    Pilot pilot = pilotOf(voyage, scene.eye);
    Tick now;
    const auto advance = [&](std::uint64_t ticks) {
        for (std::uint64_t i = 0; i < ticks; ++i, ++now.value) advancePilot(pilot, voyage, {}, now);
    };
    for (int i = 0; i < 300; ++i) {
        steer(pilot, voyage, {.ahead = -127, .aside = 100, .turn = 127}, now);
        advance(1);
    }
    EXPECT_GT(place::lengthOf(pilot.vessel.position - scene.eye), 1.0F);
    advance(voyage.idleTicks + 60 * 90);
    EXPECT_LT(place::lengthOf(pilot.vessel.position - scene.eye), 0.05F);
    EXPECT_LT(std::abs(pilot.vessel.attitude.yaw), 0.02F);
}

}  // namespace
}  // namespace aquarama::surroundings
