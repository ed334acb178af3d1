// SPDX-License-Identifier: Apache-2.0
#include "common/place/place.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/hash.h"
#include "tests/support/school_region.h"

namespace aquarama::place {
namespace {

constexpr std::uint32_t kSeed = 1;

TEST(Noise, staysWithinItsBounds) {
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const glm::vec2 place{100.0F * signedUnitOf(hashOf(7, i)),
                              100.0F * signedUnitOf(hashOf(8, i))};
        ASSERT_LE(std::abs(valueNoise(3, place)), 1.0F);
    }
}

TEST(Noise, meetsItselfAtTheLattice) {
    constexpr float kStep = 1.0e-3F;
    for (int cell = -5; cell < 5; ++cell) {
        const auto x = static_cast<float>(cell);
        EXPECT_NEAR(valueNoise(3, {x - kStep, 0.4F}), valueNoise(3, {x + kStep, 0.4F}), 1.0e-4F);
        EXPECT_NEAR(valueNoise(3, {0.4F, x - kStep}), valueNoise(3, {0.4F, x + kStep}), 1.0e-4F);
    }
}

TEST(Noise, takesAnyPlace) {
    for (const float far : {-3.0e38F, -1.0e9F, 1.0e9F, 3.0e38F})
        EXPECT_LE(std::abs(valueNoise(3, {far, -far})), 1.0F);
}

TEST(Place, sandHasNoStepAndNoCliff) {
    constexpr float kStep = 0.01F;
    for (float x = -40.0F; x < 40.0F; x += 0.37F)
        for (float z = -40.0F; z < 10.0F; z += 0.41F) {
            const float here = floorHeight({kSeed}, {x, z});
            ASSERT_NEAR(floorHeight({kSeed}, {x + kStep, z}), here, 1.2F * kStep);
            ASSERT_NEAR(floorHeight({kSeed}, {x, z + kStep}), here, 1.2F * kStep);
            ASSERT_LT(here, -kMeanFloorDepthMetres + 0.6F);
            const bool drops = x * x + z * z > 14.0F * 14.0F;
            ASSERT_TRUE(drops || here > -kMeanFloorDepthMetres - 0.6F);
        }
}

// The bits themselves, which every preset and machine must repeat: the master's world stands on
// them.
TEST(Place, sandIsTheSameToTheBit) {
    std::uint32_t hash = 0;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const glm::vec2 xz{60.0F * signedUnitOf(hashOf(1, i)), 60.0F * signedUnitOf(hashOf(2, i))};
        hash = hashOf(hash ^ std::bit_cast<std::uint32_t>(floorHeight({kSeed}, xz)));
    }
    EXPECT_EQ(hash, 1981795279U);
}

TEST(Place, anotherSeedIsAnotherPlace) {
    EXPECT_NE(floorHeight({1}, {3.0F, -7.0F}), floorHeight({2}, {3.0F, -7.0F}));
    EXPECT_NE(rocksOf({1}).front().centre, rocksOf({2}).front().centre);
    EXPECT_NE(plantsOf({1}).front().root, plantsOf({2}).front().root);
}

TEST(Place, plantsStandOnTheSandAndNotInRock) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const std::vector<Rock> rocks = rocksOf({seed});
        for (const Plant& plant : plantsOf({seed})) {
            ASSERT_EQ(plant.root.y, floorHeight({seed}, {plant.root.x, plant.root.z}));
            ASSERT_LT(plant.root.y + plant.heightMetres, 0.0F) << "grows out of the sea";
            for (const Rock& rock : rocks)
                ASSERT_GT(glm::distance(glm::vec2(rock.centre.x, rock.centre.z),
                                        glm::vec2(plant.root.x, plant.root.z)),
                          rock.radiusMetres * 0.9F);
        }
    }
}

TEST(Place, everyThirdOfTheWallHasSomethingToLookAt) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        std::array<int, 3> rocksPerThird{};
        for (const Rock& rock : rocksOf({seed})) {
            const glm::vec3 fromEye = rock.centre - kEyePosition;
            const float azimuthDegrees = 57.29578F * std::atan2(fromEye.x, -fromEye.z);
            if (std::abs(azimuthDegrees) > 60.0F || glm::length(fromEye) > 20.0F) continue;
            ++rocksPerThird.at(static_cast<std::size_t>((azimuthDegrees + 60.0F) / 40.01F));
        }
        EXPECT_GE(*std::ranges::min_element(rocksPerThird), 2);
    }
}

TEST(Place, schoolHasWaterAllRoundIt) {
    const Region region = test::schoolRegion();
    const glm::vec3 lowest = region.centre - region.halfExtent;
    const glm::vec3 highest = region.centre + region.halfExtent;
    EXPECT_LT(highest.y, -1.0F);
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        for (float x = lowest.x; x <= highest.x; x += 0.5F)
            for (float z = lowest.z; z <= highest.z; z += 0.5F)
                ASSERT_LT(floorHeight({seed}, {x, z}), lowest.y - 0.3F);
        for (const Rock& rock : rocksOf({seed})) {
            const glm::vec3 nearest = glm::clamp(rock.centre, lowest, highest);
            EXPECT_GT(glm::distance(nearest, rock.centre), 0.35F * rock.radiusMetres)
                << "a rock fills the school's water";
        }
    }
}

TEST(OpenSea, holdsNothingButWaterOverADeepFloor) {
    const PlaceKey sea{.seed = 3, .kind = config::PlaceKind::OpenSea};
    EXPECT_TRUE(rocksOf(sea).empty());
    EXPECT_TRUE(plantsOf(sea).empty());
    for (const float x : {-500.0F, 0.0F, 7.5F})
        EXPECT_EQ(floorHeight(sea, {x, -x}), -kOpenSeaFloorDepthMetres);
}

}  // namespace
}  // namespace aquarama::place
