// SPDX-License-Identifier: Apache-2.0
// The autopilot in the scenes that are shipped.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/surroundings/pilot.h"
#include "tests/master/surroundings/voyages.h"

namespace aquarama::surroundings {
namespace {

TEST(Tour, itsPathLeadsThroughItsStopsAndCloses) {
    const Tour tour = voyageIn(shippedScene("reef")).tour;
    const auto count = tour.stops.size();
    ASSERT_GE(count, 3U);
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_LT(place::lengthOf(pointOf(tour, static_cast<float>(i), {}).at - tour.stops[i].at),
                  1e-5F);
    const auto end = static_cast<float>(count);
    EXPECT_LT(place::lengthOf(pointOf(tour, end - 1e-4F, {}).at - tour.stops[0].at), 1e-2F);
}

TEST(Tour, itsSlopeIsThatOfItsPath) {
    const Tour tour = voyageIn(shippedScene("bait_ball")).tour;
    for (float along = 0.1F; along < 11.8F; along += 0.37F) {
        constexpr float kStep = 1.0F / 64;
        const glm::vec3 chord =
            (pointOf(tour, along + kStep, {}).at - pointOf(tour, along - kStep, {}).at) /
            (2 * kStep);
        EXPECT_LT(place::lengthOf(pointOf(tour, along, {}).perStop - chord), 0.02F) << along;
    }
}

TEST(Tour, roundTheOpenSeaLeadsThroughTheEyeAboutTheWater) {
    const config::Scene scene = shippedScene("bait_ball");
    const Tour tour = voyageIn(scene).tour;
    EXPECT_LT(place::lengthOf(tour.stops[0].at - scene.eye), 1e-5F);
    for (float along = 0; along < 12; along += 0.25F) {
        const glm::vec3 arm = pointOf(tour, along, {}).at - scene.water.centre;
        EXPECT_NEAR(std::sqrt(arm.x * arm.x + arm.z * arm.z), 4.2F, 0.02F);
    }
}

// One round and more of every tour: slow, smooth, clear of everything, and round it comes.
TEST(Tour, isGentleAndNeverTouches) {
    for (const char* name : {"reef", "bait_ball"}) {
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            const config::Scene scene = shippedScene(name);
            const Voyage voyage = voyageIn(scene, seed);
            Pilot pilot = pilotOf(voyage, scene.eye);
            float fastest = 0;
            float hardest = 0;
            float turned = 0;
            float swung = 0;
            float least = 9;
            float astray = 0;
            int rounds = 0;
            for (Tick now; now.value < 60 * 300; ++now.value) {
                const Vessel before = pilot.vessel;
                const float along = pilot.along;
                advancePilot(pilot, voyage, {1, -6, -5}, now);
                const Vessel& is = pilot.vessel;
                fastest = std::max(fastest, place::lengthOf(is.velocity));
                hardest = std::max(hardest, place::lengthOf(is.velocity - before.velocity) * 60);
                turned = std::max(turned, std::abs(is.rate.yaw));
                swung = std::max(swung, std::abs(is.rate.yaw - before.rate.yaw) * 60);
                least = std::min(least, gapAt(voyage.waters, is.position));
                rounds += pilot.along < along ? 1 : 0;
                if (pilot.touring)
                    astray = std::max(
                        astray,
                        place::lengthOf(pointOf(voyage.tour, pilot.along, {}).at - is.position));
            }
            EXPECT_LT(fastest, 0.6F) << name;
            EXPECT_GT(fastest, 0.3F) << name;
            EXPECT_LT(hardest, 0.3F) << name;
            EXPECT_LT(turned * 180 / place::kPi, 8.5F) << name << ": degrees a second";
            EXPECT_LT(swung * 180 / place::kPi, 6.0F) << name << ": degrees a second squared";
            EXPECT_GT(least, 0.0F) << name << ' ' << seed;
            EXPECT_LT(astray, 1.2F) << name << ' ' << seed;
            EXPECT_GE(rounds, 1) << name << ' ' << seed;
        }
    }
}

}  // namespace
}  // namespace aquarama::surroundings
