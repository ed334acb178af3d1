// SPDX-License-Identifier: Apache-2.0
// What a chart or a grid finds near a place is what a search among all finds.
#include <gtest/gtest.h>

#include "common/base/hash.h"
#include "common/place/obstacles.h"
#include "master/behaviour/grids.h"
#include "master/behaviour/loops.h"
#include "master/behaviour/vision.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {
namespace {

const place::Region kKnownWater{{0, -5.5F, -5.5F}, {11, 2.7F, 8}};

glm::vec3 drawn(std::uint32_t hash, float reach) {
    return glm::vec3{
               signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))} *
           reach;
}

TEST(Chart, HidesAndRisesAsAllRocksDo) {
    const place::Obstacles charted = place::obstaclesOf({.seed = 3}, kKnownWater);
    place::Obstacles plain = charted;
    plain.chart = {};
    std::size_t hidden = 0;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const glm::vec3 from =
            kKnownWater.centre + drawn(hashOf(i, 0), 1) * kKnownWater.halfExtent * 1.1F;
        // Above the sand, which a chart knows to some millimetres alone.
        glm::vec3 to = from + drawn(hashOf(i, 1), 12);
        to.y = std::max(to.y, -8.0F);
        const SightLine ray{from, to - from};
        EXPECT_EQ(terrainHides(charted, ray), terrainHides(plain, ray)) << i;
        hidden += terrainHides(plain, ray) ? 1 : 0;
        const glm::vec2 xz{from.x, from.z};
        EXPECT_NEAR(surroundings::groundAt(charted, xz), surroundings::groundAt(plain, xz), 0.006F);
    }
    EXPECT_GT(hidden, 1000U);
}

// The nearest of the places that are visited, and how many these are.
std::pair<std::uint32_t, std::size_t> nearestOf(const PlacesKnown& known,
                                                const std::vector<glm::vec3>& places,
                                                glm::vec3 from) {
    std::uint32_t nearest = 0;
    std::size_t visited = 0;
    float least = std::numeric_limits<float>::infinity();
    PlacesKnown::findOutwards([&](float reachSquared) {
        known.visit(from, reachSquared, places.size(), [&](std::uint32_t i) {
            ++visited;
            const float distance = place::lengthOf(places[i] - from);
            if (distance > least || (distance == least && i > nearest)) return;
            least = distance;
            nearest = i;
        });
        return least * least <= reachSquared;
    });
    return {nearest, visited};
}

TEST(PlacesKnown, FindTheNearestOfAll) {
    std::vector<glm::vec3> places;
    for (std::uint32_t i = 0; i < 4000; ++i)
        places.push_back(kKnownWater.centre + drawn(hashOf(i, 7), 1.2F) * kKnownWater.halfExtent);
    PlacesKnown known;
    known.take(kKnownWater, places.size(), [&](std::uint32_t i) { return places[i]; });
    std::size_t visited = 0;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::vec3 from =
            kKnownWater.centre + drawn(hashOf(i, 8), 1.5F) * kKnownWater.halfExtent;
        const auto [nearest, count] = nearestOf(known, places, from);
        EXPECT_EQ(nearest, nearestOf(PlacesKnown{}, places, from).first);
        visited += count;
    }
    EXPECT_LT(visited, 500 * places.size() / 4);
}

TEST(Loops, AreThoseThatAreMadeWhenAskedFor) {
    surroundings::Turf turf;
    for (std::uint32_t i = 0; i < 90; ++i) {
        turf.patches.push_back({.place = drawn(hashOf(i, 9), 8)});
        turf.fill.push_back(surroundings::Turf::kFull);
    }
    std::vector<fish::SpeciesParameters> cast(2);
    cast[0].last = cast[1].first = 5;
    cast[1].last = 9;
    cast[1].kind = 1;
    cast[1].habits.graze = config::Graze{.manner = config::GrazeManner::Loop};
    const Loops loops(turf, 6, cast);
    EXPECT_EQ(loops.of(cast[0], 2), nullptr);
    for (std::uint32_t fish = 5; fish < 9; ++fish)
        EXPECT_EQ(loops.of(cast[1], fish)->patches, loopOf(turf, 6, fish).patches);
}

}  // namespace
}  // namespace aquarama::behaviour
