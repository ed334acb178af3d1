// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/place/place.h"

namespace aquarama::place {
namespace {

constexpr float kLength = 0.24F;

config::Scene sceneAt(config::PlaceKind place) {
    config::Scene scene;
    scene.place = place;
    scene.cast = {{.species = "scad.txtpb", .fish = 51, .place = {17, 8}}};
    scene.eyePlace = {5, 1};
    scene.waterPlace = {7, 1};
    return scene;
}

double roomOfEach(const Region& water, std::size_t fish) {
    const glm::dvec3 half = water.halfExtent;
    return 8 * half.x * half.y * half.z / static_cast<double>(fish) / (0.24 * 0.24 * 0.24);
}

TEST(Water, ofAFewFishIsTheScenesOwn) {
    for (const config::PlaceKind place : {config::PlaceKind::Reef, config::PlaceKind::OpenSea}) {
        const config::Scene scene = sceneAt(place);
        for (const std::size_t fish : {0U, 60U, 4000U}) {
            EXPECT_EQ(waterFor(scene, fish, kLength).centre, scene.water.centre);
            EXPECT_EQ(waterFor(scene, fish, kLength).halfExtent, scene.water.halfExtent);
        }
    }
}

TEST(Water, ofManyFishGivesEachItsRoomAndKeepsTheFaceTowardsTheEyeAndTheTop) {
    for (const config::PlaceKind place : {config::PlaceKind::Reef, config::PlaceKind::OpenSea})
        for (const std::size_t fish : {10'000U, 100'000U, 160'000U}) {
            const config::Scene scene = sceneAt(place);
            const config::SceneWater& box = scene.water;
            const Region water = waterFor(scene, fish, kLength);
            EXPECT_NEAR(roomOfEach(water, fish), box.leastLengthsCubed, 1e-3);
            EXPECT_NEAR(
                water.centre.z + water.halfExtent.z, box.centre.z + box.halfExtent.z, 1e-3F);
            EXPECT_NEAR(
                water.centre.y + water.halfExtent.y, box.centre.y + box.halfExtent.y, 1e-3F);
            EXPECT_EQ(water.centre.x, box.centre.x);
        }
}

TEST(Water, ofAReefDoesNotGrowIntoTheSand) {
    const config::Scene scene = sceneAt(config::PlaceKind::Reef);
    EXPECT_EQ(waterFor(scene, 100'000, kLength).halfExtent.y, scene.water.halfExtent.y);
}

TEST(Water, ofAMillionFishStaysAboveTheFloorOfTheOpenSea) {
    const Region water = waterFor(sceneAt(config::PlaceKind::OpenSea), kMostFish, kLength);
    EXPECT_GT(water.centre.y - water.halfExtent.y, -kOpenSeaFloorDepthMetres);
    EXPECT_NEAR(roomOfEach(water, kMostFish), 4, 1e-3);
}

std::string refusalOf(const config::Scene& scene, std::size_t fish) {
    try {
        checkRoom(scene, "sea.txtpb", fish, kLength);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Room, ofAReefEndsSomewhereAndThatOfTheOpenSeaDoesNot) {
    const std::uint32_t most = mostFishIn(sceneAt(config::PlaceKind::Reef), kLength);
    EXPECT_GT(most, 100'000U);
    EXPECT_EQ(refusalOf(sceneAt(config::PlaceKind::Reef), most), "accepted");
    const std::string refusal = refusalOf(sceneAt(config::PlaceKind::Reef), most + 1);
    EXPECT_THAT(refusal, testing::StartsWith("sea.txtpb:17:8: "));
    EXPECT_THAT(refusal, testing::HasSubstr("room for " + std::to_string(most)));
    EXPECT_EQ(refusalOf(sceneAt(config::PlaceKind::OpenSea), kMostFish), "accepted");
    EXPECT_THAT(refusalOf(sceneAt(config::PlaceKind::OpenSea), kMostFish + 1),
                testing::HasSubstr("take fewer"));
}

TEST(Room, theTourStaysWhereTheSubmarineMayGo) {
    config::Scene scene = sceneAt(config::PlaceKind::Reef);
    const Region roaming = roamingRegion({scene.water.centre, scene.water.halfExtent}, scene.eye);
    EXPECT_LT(roaming.centre.y + roaming.halfExtent.y, -0.5F) << "below the surface";
    const auto refusalOfStop = [&](glm::vec3 at) {
        scene.tour = config::SceneTour{};
        scene.tour->stops = {{.at = at, .lookAt = {}, .place = {9, 3}}};
        return refusalOf(scene, 60);
    };
    EXPECT_EQ(refusalOfStop(scene.eye), "accepted");
    EXPECT_THAT(refusalOfStop(scene.eye + glm::vec3(0, 0, 5)),
                testing::StartsWith("sea.txtpb:9:3: the stop is out of"));
    EXPECT_THAT(refusalOfStop({0, -7.5F, -4}), testing::HasSubstr("too near to the sand"));
}

TEST(Room, isNotInTheSand) {
    config::Scene scene = sceneAt(config::PlaceKind::Reef);
    scene.eye.y = -8.5F;
    EXPECT_THAT(refusalOf(scene, 60), testing::StartsWith("sea.txtpb:5:1: the eye"));
    scene.place = config::PlaceKind::OpenSea;
    EXPECT_EQ(refusalOf(scene, 60), "accepted");
    scene = sceneAt(config::PlaceKind::Reef);
    scene.water.centre.y = -9;
    EXPECT_THAT(refusalOf(scene, 60), testing::StartsWith("sea.txtpb:7:1: the water"));
}

}  // namespace
}  // namespace aquarama::place
