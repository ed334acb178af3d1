// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/neighbours.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/angle.h"
#include "master/behaviour/perceive/spatial_grid.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama {
namespace {

using Seen = std::pair<float, std::uint32_t>;  // squared distance, fish

void rebuild(SpatialGrid& grid, const FishView& view) {
    std::vector<std::uint32_t> all(view.size());
    std::iota(all.begin(), all.end(), 0U);
    grid.rebuild({view.x, view.y, view.z}, all);
}

std::vector<Seen> nearestByBruteForce(const FishView& view, std::uint32_t fish) {
    std::vector<Seen> seen;
    for (std::uint32_t other = 0; other < view.size(); ++other) {
        const glm::vec3 offset = view.position(other) - view.position(fish);
        const float distanceSquared = dot(offset, offset);
        if (other != fish && distanceSquared <= kSightMetres * kSightMetres &&
            inFieldOfView(view.heading(fish), offset))
            seen.emplace_back(distanceSquared, other);
    }
    std::sort(seen.begin(), seen.end());
    if (seen.size() > kMostNeighbours) seen.resize(kMostNeighbours);
    return seen;
}

void expectSearchEqualsBruteForce(const FishView& view, const Region& water) {
    SpatialGrid grid(water, kCellMetres, view.size());
    rebuild(grid, view);
    for (std::uint32_t fish = 0; fish < view.size(); ++fish) {
        const Neighbours found = nearestVisible(view, grid, fish);
        std::vector<Seen> seen;
        for (std::size_t i = 0; i < found.count; ++i)
            seen.emplace_back(found.distanceSquared[i], found.fish[i]);
        ASSERT_EQ(seen, nearestByBruteForce(view, fish)) << "fish " << fish;
    }
}

TEST(Neighbours, theGridFindsWhatBruteForceFinds) {
    const Region water{{1, -6, -5}, {3, 1.5F, 2}};
    for (const std::size_t fish : {1U, 2U, 51U, 700U, 3000U}) {
        SCOPED_TRACE(fish);
        expectSearchEqualsBruteForce(scatteredSchool(7, fish, water), water);
    }
}

TEST(Neighbours, theGridFindsFishThatStrayedOutOfTheWater) {
    const Region water{{1, -6, -5}, {3, 1.5F, 2}};
    const Region wider{water.centre, water.halfExtent * 1.6F};
    expectSearchEqualsBruteForce(scatteredSchool(8, 900, wider), water);
}

TEST(Neighbours, ofEquallyNearFishTheLowerIndexComesFirst) {
    const Region water{{0, 0, 0}, {2, 2, 2}};
    FishView view = scatteredSchool(9, 12, water);
    for (std::size_t i = 0; i < 12; ++i) {
        view.x[i] = i == 5 ? 0.0F : 0.5F;  // eleven at one point, ahead of fish 5
        view.y[i] = view.z[i] = 0;
        view.headingX[i] = 1;
        view.headingY[i] = view.headingZ[i] = 0;
    }
    SpatialGrid grid(water, kCellMetres, view.size());
    rebuild(grid, view);
    const Neighbours found = nearestVisible(view, grid, 5);
    EXPECT_EQ(found.fish, (std::array<std::uint32_t, kMostNeighbours>{0, 1, 2, 3, 4, 6, 7}));
}

TEST(Neighbours, aFishIsBlindThirtyDegreesAboutStraightBehind) {
    const glm::vec3 heading{0, 0, -1};
    EXPECT_TRUE(inFieldOfView(heading, {0, 0, -3}));
    EXPECT_TRUE(inFieldOfView(heading, {1, 0, 0}));
    EXPECT_TRUE(inFieldOfView(heading, {0.515F, 0, 0.857F})) << "31 degrees from behind";
    EXPECT_FALSE(inFieldOfView(heading, {0.485F, 0, 0.875F})) << "29 degrees from behind";
    EXPECT_FALSE(inFieldOfView(heading, {0, 0, 2}));
}

}  // namespace
}  // namespace aquarama
