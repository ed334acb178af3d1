// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/scene/detail_tiles.h"
#include "render_node/scene/ground.h"
#include "render_node/scene/plant_mesh.h"
#include "render_node/scene/reef.h"
#include "render_node/scene/rock_mesh.h"
#include "render_node/scene/shade.h"
#include "render_node/shaders/plant_bend.h"

namespace aquarama {
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
            return bentStem(static_cast<float>(k) / kPieces, height, push);
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
    EXPECT_EQ(bentStem(0.0F, 5.0F, {1.0F, 1.0F}), glm::vec3(0.0F));
    EXPECT_EQ(bentStem(1.0F, 5.0F, {0.0F, 0.0F}), glm::vec3(0.0F, 5.0F, 0.0F));
}

TEST(Plants, fartherLevelsHaveFewerTriangles) {
    for (const PlantKind kind : {PlantKind::Kelp, PlantKind::Seagrass})
        for (int level = 1; level < 3; ++level)
            EXPECT_LT(growPlant(kind, level).indices.size(),
                      growPlant(kind, level - 1).indices.size());
}

TEST(Reef, coralsKeepToTheirBoulder) {
    const std::vector<Rock> rocks = rocksOf({kSeed});
    for (const Rock& rock : rocks) {
        std::size_t triangles = ~std::size_t{0};
        for (int level = 1; level < kReefLevels; ++level) {
            const ReefMesh mesh = growBoulder(rock, rocks, level);
            ASSERT_TRUE(namesItsOwnVertices(mesh.stone));
            ASSERT_TRUE(namesItsOwnVertices(mesh.growth));
            const std::size_t count = mesh.stone.indices.size() + mesh.growth.indices.size();
            EXPECT_LE(count, triangles) << "level " << level;
            triangles = count;
            for (const SolidVertex& vertex : mesh.growth.vertices)
                ASSERT_LT(glm::distance(vertex.position, rock.centre), rock.radiusMetres + 1.6F);
        }
    }
}

// Fish keep clear of the ball: no stone may stand out of it.
TEST(Reef, stoneKeepsWithinItsBall) {
    for (const Rock& rock : rocksOf({kSeed})) {
        Mesh mesh;
        addBoulder(mesh, rock, 1);
        for (const SolidVertex& vertex : mesh.vertices)
            ASSERT_LE(glm::distance(vertex.position, rock.centre), rock.radiusMetres * 1.001F);
    }
}

TEST(Reef, stoneLooksOutward) {
    const Rock rock = rocksOf({kSeed}).front();
    Mesh mesh;
    addBoulder(mesh, rock, 0);
    int inward = 0;
    for (const SolidVertex& vertex : mesh.vertices)
        inward += glm::dot(glm::vec3(vertex.normal), vertex.position - rock.centre) < 0.0F ? 1 : 0;
    EXPECT_LT(inward, static_cast<int>(mesh.vertices.size() / 50)) << "but for overhangs";
}

TEST(Ground, theSandIsWhereTheMasterHasIt) {
    constexpr int kCells = 24;
    const Mesh mesh = layPatch(kSeed, {-5.0F, -10.0F}, 10.0F, kCells);
    ASSERT_TRUE(namesItsOwnVertices(mesh));
    int onSand = 0;
    for (const SolidVertex& vertex : mesh.vertices) {
        const float sand = floorHeight({kSeed}, {vertex.position.x, vertex.position.z});
        ASSERT_LE(vertex.position.y, sand);
        onSand += vertex.position.y == sand ? 1 : 0;
    }
    EXPECT_EQ(onSand, (kCells + 1) * (kCells + 1)) << "all but the rim that hangs down";
}

TEST(Shade, aBoulderShadesWhatLiesBehindIt) {
    const std::array rocks{Rock{{0.0F, -8.0F, 0.0F}, 1.0F, 1}};
    const glm::vec3 behind = rocks[0].centre - 2.0F * sunInWater();
    EXPECT_LT(sunOpenness(rocks, behind), 0.05F);
    EXPECT_EQ(sunOpenness(rocks, rocks[0].centre + 2.0F * sunInWater()), 1.0F);
    EXPECT_LT(skyOpenness(rocks, {0.9F, -8.0F, 0.0F}, {0.0F, 1.0F, 0.0F}), 0.75F);
    EXPECT_GT(skyOpenness(rocks, {7.0F, -8.0F, 0.0F}, {0.0F, 1.0F, 0.0F}), 0.95F);
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
}  // namespace aquarama
