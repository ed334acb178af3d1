// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/reef/ground.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/reef.h"
#include "render_node/reef/scatter.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/plant_bend.h"

namespace aquarama::scene {
namespace {

constexpr std::uint32_t kSeed = 1;

bool namesItsOwnVertices(const Mesh& mesh) {
    return mesh.indices.size() % 3 == 0 && std::ranges::all_of(mesh.indices, [&](std::uint32_t i) {
               return i < mesh.vertices.size();
           });
}

float lengthOfStem(float height, glm::vec2 push) {
    constexpr int kPieces = 400;
    float length = 0.0F;
    for (int i = 0; i < kPieces; ++i) {
        const auto at = [&](int k) {
            return shaders::bentStem(static_cast<float>(k) / kPieces, height, push);
        };
        length += glm::distance(at(i), at(i + 1));
    }
    return length;
}

TEST(Plants, aStemKeepsItsLengthAsItSways) {
    constexpr float kHeight = 7.0F;
    for (const float push : {0.0F, 0.5F, 1.0F, 1.6F})
        EXPECT_NEAR(lengthOfStem(kHeight, {push, 0.3F * push}), kHeight, 0.01F * kHeight) << push;
}

TEST(Plants, aStemStandsOnItsRootAndRisesWithoutWater) {
    EXPECT_EQ(shaders::bentStem(0.0F, 5.0F, {1.0F, 1.0F}), glm::vec3(0.0F));
    EXPECT_EQ(shaders::bentStem(1.0F, 5.0F, {0.0F, 0.0F}), glm::vec3(0.0F, 5.0F, 0.0F));
}

const Library& library() {
    static const Library all = growLibrary();
    return all;
}

const std::vector<Instance>& instances() {
    static const std::vector<Instance> all = scatter({kSeed});
    return all;
}

bool isRock(const Instance& one) {
    return one.prototype < kRockShapes;
}

TEST(Library, fartherLevelsHaveFewerTriangles) {
    for (std::size_t i = 0; i < kPrototypes; ++i) {
        std::size_t triangles = ~std::size_t{0};
        for (const Mesh& mesh : library()[i]) {
            ASSERT_FALSE(mesh.indices.empty()) << i;
            ASSERT_TRUE(namesItsOwnVertices(mesh)) << i;
            EXPECT_LT(mesh.indices.size(), triangles) << i;
            triangles = mesh.indices.size();
        }
        EXPECT_LE(triangles / 3, 240U) << i << ": the coarsest is for what is small";
    }
}

// A level that were larger or smaller than the next would be seen to jump.
TEST(Library, levelsAreAboutAsLarge) {
    const auto halfExtentOf = [](const Mesh& mesh) {
        glm::vec3 low{1.0e9F};
        glm::vec3 high{-1.0e9F};
        for (const SolidVertex& vertex : mesh.vertices) {
            low = glm::min(low, vertex.position);
            high = glm::max(high, vertex.position);
        }
        return glm::length(high - low) / 2.0F;
    };
    for (std::size_t i = 0; i < kPrototypes; ++i)
        for (std::size_t level = 1; level < kLevels; ++level)
            EXPECT_NEAR(
                halfExtentOf(library()[i].at(level)) / halfExtentOf(library()[i][0]), 1.0F, 0.3F)
                << "prototype " << i << " level " << level;
}

TEST(Library, stoneLooksOutward) {
    for (std::size_t shape = 0; shape < kRockShapes; ++shape) {
        const Mesh& mesh = library().at(shape)[1];
        std::size_t inward = 0;
        for (const SolidVertex& vertex : mesh.vertices)
            inward += glm::dot(glm::vec3(vertex.normal), vertex.position) < 0.0F ? 1 : 0;
        EXPECT_LT(inward, mesh.vertices.size() / 50) << "but for overhangs";
    }
}

TEST(Scatter, followsFromTheSeed) {
    const auto same = scatter({kSeed});
    ASSERT_EQ(same.size(), instances().size());
    EXPECT_EQ(std::memcmp(same.data(), instances().data(), same.size() * sizeof(Instance)), 0);
    const auto other = scatter({kSeed + 1});
    EXPECT_NE(other.front().placeAndScale, same.front().placeAndScale);
}

// Fish keep clear of the balls that the master knows: each holds the stone that is drawn.
TEST(Scatter, stoneKeepsWithinTheBallsThatFishAvoid) {
    const std::vector<place::Rock> rocks = place::rocksOf({kSeed});
    std::size_t boulders = 0;
    for (const Instance& one : instances()) {
        if (!isRock(one)) continue;
        const glm::vec3 centre(one.placeAndScale);
        const bool known = std::ranges::any_of(rocks, [&](const place::Rock& rock) {
            return rock.centre == centre && rock.radiusMetres == one.placeAndScale.w;
        });
        boulders += known ? 1 : 0;
        ASSERT_TRUE(known || one.placeAndScale.w < 0.3F) << "a pebble lies below any fish";
    }
    EXPECT_EQ(boulders, rocks.size());
    for (std::size_t shape = 0; shape < kRockShapes; ++shape)
        for (const SolidVertex& vertex : library().at(shape)[0].vertices)
            ASSERT_LE(glm::length(vertex.position), 1.0F);
}

TEST(Scatter, allStandsOnSandOrStone) {
    const std::vector<place::Rock> rocks = place::rocksOf({kSeed});
    for (const Instance& one : instances()) {
        if (isRock(one)) continue;
        const glm::vec3 root(one.placeAndScale);
        const float aboveSand = root.y - place::floorHeight({kSeed}, {root.x, root.z});
        EXPECT_GT(aboveSand, -0.2F);
        if (aboveSand < 0.05F) continue;
        EXPECT_TRUE(std::ranges::any_of(rocks, [&](const place::Rock& rock) {
            return glm::distance(rock.centre, root) < 1.001F * rock.radiusMetres;
        })) << "it floats";
    }
}

TEST(Scatter, noThirdOfTheWallIsBareAndNoWayRoundIsEmpty) {
    std::array<int, 9> inSector{};  // of 40 degrees, all round
    for (const Instance& one : instances()) {
        const glm::vec3 way = glm::vec3(one.placeAndScale) - place::kEyePosition;
        if (glm::length(way) > 16.0F || one.placeAndScale.w < 0.2F) continue;
        const float azimuth = std::atan2(way.x, -way.z) / (2.0F * std::numbers::pi_v<float>);
        ++inSector.at(static_cast<std::size_t>((azimuth + 1.0F + 0.5F / 9.0F) * 9.0F) % 9);
    }
    EXPECT_GT(*std::ranges::min_element(inSector), 20);
}

TEST(Ground, theSandIsWhereTheMasterHasIt) {
    constexpr int kCells = 24;
    const Mesh mesh = layPatch(kSeed, {-5.0F, -10.0F}, 10.0F, kCells);
    ASSERT_TRUE(namesItsOwnVertices(mesh));
    int onSand = 0;
    for (const SolidVertex& vertex : mesh.vertices) {
        const float sand = place::floorHeight({kSeed}, {vertex.position.x, vertex.position.z});
        ASSERT_LE(vertex.position.y, sand);
        onSand += vertex.position.y == sand ? 1 : 0;
    }
    EXPECT_EQ(onSand, (kCells + 1) * (kCells + 1)) << "all but the rim that hangs down";
}

TEST(Shade, aBoulderShadesWhatLiesBehindIt) {
    const std::array rocks{place::Rock{{0.0F, -8.0F, 0.0F}, 1.0F, 1}};
    const glm::vec3 behind = rocks[0].centre - 2.0F * sunInWater();
    EXPECT_LT(sunVisibility(rocks, behind), 0.05F);
    EXPECT_EQ(sunVisibility(rocks, rocks[0].centre + 2.0F * sunInWater()), 1.0F);
    EXPECT_LT(ambientOcclusion(rocks, {0.9F, -8.0F, 0.0F}, {0.0F, 1.0F, 0.0F}), 0.75F);
    EXPECT_GT(ambientOcclusion(rocks, {7.0F, -8.0F, 0.0F}, {0.0F, 1.0F, 0.0F}), 0.95F);
}

TEST(Tiles, reliefIsLevelOnTheWhole) {
    for (const Tile& tile : {sandTile(), rockTile()}) {
        glm::dvec2 sum{0.0};
        for (const glm::u8vec4& value : tile.values) sum += glm::dvec2(value.x, value.y);
        const glm::dvec2 mean = sum / static_cast<double>(tile.values.size());
        EXPECT_NEAR(mean.x, 127.5, 2.0);
        EXPECT_NEAR(mean.y, 127.5, 2.0);
    }
}

}  // namespace
}  // namespace aquarama::scene
