// SPDX-License-Identifier: Apache-2.0
// Who steers, and that the same hands do the same.
#include "master/surroundings/pilot.h"

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/surroundings/voyages.h"

namespace aquarama::surroundings {
namespace {

constexpr Steering kAhead{.ahead = kFullSteering};

void run(Pilot& pilot, const Voyage& voyage, Tick& now, std::uint64_t ticks) {
    for (const std::uint64_t end = now.value + ticks; now.value < end; ++now.value)
        advancePilot(pilot, voyage, {}, now);
}

TEST(Pilot, staysAtTheEyeToTheBitWhereTheSceneHasNoTour) {
    const config::Scene scene = shippedScene("routines/school");
    const Voyage voyage = voyageIn(scene);
    ASSERT_TRUE(voyage.stays);
    Pilot pilot = pilotOf(voyage, scene.eye);
    const std::uint64_t hash = foldedPilot(1, pilot);
    Tick now;
    run(pilot, voyage, now, 60 * 120);
    EXPECT_EQ(pilot.vessel.position, scene.eye);
    EXPECT_EQ(foldedPilot(1, pilot), hash);
}

TEST(Pilot, aHandThatFallsSilentLetsGoAfterHalfASecond) {
    const config::Scene scene = shippedScene("empty_sea");
    const Voyage voyage = voyageIn(scene);
    Pilot pilot = pilotOf(voyage, scene.eye);
    Tick now;
    steer(pilot, voyage, kAhead, now);
    run(pilot, voyage, now, kTicksOfAHand);
    const float push = pilot.vessel.push.ahead;
    EXPECT_EQ(push, 1);
    run(pilot, voyage, now, 1);
    EXPECT_LT(pilot.vessel.push.ahead, push);
    run(pilot, voyage, now, 60);
    EXPECT_EQ(pilot.vessel.push.ahead, 0);
}

TEST(Pilot, aHandThatSpeaksOnHoldsOnAndOneThatLetsGoLetsGoAtOnce) {
    const config::Scene scene = shippedScene("empty_sea");
    const Voyage voyage = voyageIn(scene);
    Pilot pilot = pilotOf(voyage, scene.eye);
    Tick now;
    for (int i = 0; i < 10; ++i) {
        steer(pilot, voyage, kAhead, now);
        run(pilot, voyage, now, kTicksOfAHand - 1);
    }
    EXPECT_EQ(pilot.vessel.push.ahead, 1);
    steer(pilot, voyage, {}, now);
    run(pilot, voyage, now, 60);
    EXPECT_EQ(pilot.vessel.push.ahead, 0);
}

TEST(Pilot, whoHoldsNothingDoesNotKeepTheAutopilotAway) {
    const config::Scene scene = shippedScene("bait_ball");
    ASSERT_TRUE(scene.tour);
    const Voyage voyage = voyageIn(scene);
    Pilot pilot = pilotOf(voyage, scene.eye);
    Tick now;
    for (std::uint64_t i = 0; i < voyage.idleTicks + 60; ++i) {
        steer(pilot, voyage, {}, now);
        EXPECT_EQ(pilot.touring, now.value > voyage.idleTicks) << now.value;
        run(pilot, voyage, now, 1);
    }
    EXPECT_TRUE(pilot.touring);
}

TEST(Pilot, sameHandsSameBits) {
    const config::Scene scene = shippedScene("reef");
    const Voyage voyage = voyageIn(scene);
    const auto hashAfter = [&](std::uint32_t seed) {
        Pilot pilot = pilotOf(voyage, scene.eye);
        std::uint64_t hash = 0;
        for (Tick now; now.value < 60 * 60; ++now.value) {
            if (now.value % 5 == 0 && now.value < 60 * 30)
                steer(pilot, voyage, whim(seed, now.value), now);
            advancePilot(pilot, voyage, {1, -6, -5}, now);
            hash = foldedPilot(hash, pilot);
        }
        return hash;
    };
    EXPECT_EQ(hashAfter(7), hashAfter(7));
    EXPECT_NE(hashAfter(7), hashAfter(8));
}

}  // namespace
}  // namespace aquarama::surroundings
