// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/structures.h"

#include <gtest/gtest.h>

#include "tests/support/school_region.h"

namespace aquarama::surroundings {
namespace {

TEST(Structures, standInTheWaterApartFromOneAnotherTheHighestFirst) {
    const place::Region water{{0, -5.75F, -3.6F}, {7.4F, 2.45F, 6.1F}};
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const std::vector<Structure> structures = structuresOf(place::obstaclesOf({seed}, water));
        ASSERT_GE(structures.size(), 4U);
        for (std::size_t i = 0; i < structures.size(); ++i) {
            const Structure& one = structures[i];
            EXPECT_LT(std::abs(one.crown.x - water.centre.x), water.halfExtent.x);
            EXPECT_LT(std::abs(one.crown.z - water.centre.z), water.halfExtent.z);
            EXPECT_GE(one.liking, 0.3F);
            EXPECT_LE(one.liking, 1);
            for (std::size_t other = 0; other < i; ++other) {
                EXPECT_GE(structures[other].crown.y, one.crown.y);
                const glm::vec3 apart = structures[other].crown - one.crown;
                EXPECT_GT(apart.x * apart.x + apart.z * apart.z, 4);
            }
        }
    }
}

TEST(Structures, areNoneInTheOpenSea) {
    EXPECT_TRUE(
        structuresOf(place::obstaclesOf({1, config::PlaceKind::OpenSea}, test::schoolRegion()))
            .empty());
}

}  // namespace
}  // namespace aquarama::surroundings
