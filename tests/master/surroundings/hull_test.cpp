// SPDX-License-Identifier: Apache-2.0
// The submarine against what stands in the sea.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/surroundings/vessel.h"
#include "tests/master/surroundings/voyages.h"

namespace aquarama::surroundings {
namespace {

// Full ahead in one direction of the world, whatever the nose does.
struct Straight {
    glm::vec3 at;
    glm::vec3 velocity{};
    float hardest = 0;  // change of velocity, metres a second squared

    void run(const Waters& waters, glm::vec3 way, int ticks) {
        for (int i = 0; i < ticks; ++i) {
            const glm::vec3 before = velocity;
            velocity += (way * 1.2F - velocity) * 0.02F;
            moveHull(waters, at, velocity);
            hardest = std::max(hardest, place::lengthOf(velocity - before) / kTickSeconds);
        }
    }
};

TEST(Hull, comesToRestAtTheStandOffBeforeEachBorder) {
    const Waters waters = voyageIn(shippedScene("empty_sea")).waters;
    for (const glm::vec3 way : {glm::vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}) {
        Straight hull{.at = {0, -9, 0}};
        hull.run(waters, way, 60 * 60);
        EXPECT_GT(gapAt(waters, hull.at), 0.8F * kStandOffMetres);
        EXPECT_LT(gapAt(waters, hull.at), 1.2F * kStandOffMetres);
        EXPECT_LT(hull.hardest, 3 * kBrakingMetres);
    }
    EXPECT_LT(waters.region.centre.y + waters.region.halfExtent.y, -kHullRadiusMetres);
}

TEST(Hull, slidesOverTheSandAndRoundRocks) {
    const Voyage voyage = voyageIn(shippedScene("reef"));
    Straight sinking{.at = {0, -6, -1}};
    sinking.run(voyage.waters, {0.5F, -0.8F, 0}, 60 * 6);
    EXPECT_GT(gapAt(voyage.waters, sinking.at), 0);
    EXPECT_GT(std::abs(sinking.at.x), 1.0F) << "it goes on along the sand";
    for (const place::Rock& rock : voyage.waters.rocks) {
        const glm::vec3 from{rock.centre.x + 0.1F, -6.2F, std::min(rock.centre.z + 5, 2.0F)};
        if (gapAt(voyage.waters, from) < kStandOffMetres) continue;
        Straight hull{.at = from};
        hull.run(voyage.waters, place::directionOf(rock.centre - from, {0, 0, -1}), 60 * 30);
        EXPECT_GE(gapAt(voyage.waters, hull.at), 0) << rock.centre.x << ' ' << rock.centre.z;
        EXPECT_LT(hull.hardest, 6 * kBrakingMetres);
    }
}

TEST(Hull, thatBeginsTooNearIsLedAwayGently) {
    const Waters waters = voyageIn(shippedScene("reef")).waters;
    glm::vec3 at{0, 0, 0};
    at.y = place::floorHeight(waters.place, {0, 0}) + 0.5F * kHullRadiusMetres;
    ASSERT_LT(gapAt(waters, at), 0);
    glm::vec3 velocity{};
    float fastest = 0;
    for (int i = 0; i < 60 * 20; ++i) {
        moveHull(waters, at, velocity);
        fastest = std::max(fastest, place::lengthOf(velocity));
    }
    EXPECT_GT(gapAt(waters, at), 0.5F * kStandOffMetres);
    EXPECT_LT(fastest, 0.2F);
}

// Nobody drives it into anything: minutes of whims, from many seeds, in a reef with kelp.
TEST(Hull, isNeverInsideAnythingWhateverHandsDo) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const config::Scene scene = shippedScene("reef");
        const Voyage voyage = voyageIn(scene, seed);
        Pilot pilot = pilotOf(voyage, scene.eye);
        float least = 9;
        float hardest = 0;
        float roamed = 0;
        for (Tick tick{}; tick.value < 60 * 180; ++tick.value) {
            if (tick.value % 6 == 0) steer(pilot, voyage, whim(seed, tick.value), tick);
            const glm::vec3 before = pilot.vessel.velocity;
            advancePilot(pilot, voyage, {}, tick);
            least = std::min(least, gapAt(voyage.waters, pilot.vessel.position));
            hardest =
                std::max(hardest, place::lengthOf(pilot.vessel.velocity - before) / kTickSeconds);
            roamed = std::max(roamed, place::lengthOf(pilot.vessel.position - scene.eye));
        }
        EXPECT_GT(least, 0.8F * kStandOffMetres) << seed;
        EXPECT_GT(roamed, 4) << seed;
        EXPECT_LT(hardest, 3 * kBrakingMetres) << seed;
    }
}

}  // namespace
}  // namespace aquarama::surroundings
