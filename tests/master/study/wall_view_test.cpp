// SPDX-License-Identifier: Apache-2.0
#include "master/study/wall_view.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "common/base/units.h"
#include "common/config/rig.h"

namespace aquarama::study {
namespace {

config::Rig rigOf(const std::string& name) {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
}

const WallExtent& theatre() {
    static const WallExtent extent(rigOf("theatre"));
    return extent;
}

glm::dvec3 directionAt(double azimuthDegrees, double elevationDegrees) {
    const double azimuth = azimuthDegrees * kDegree;
    const double elevation = elevationDegrees * kDegree;
    return {std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

// A fish of the first species across the line of sight, its middle there, as seen from kEye.
constexpr glm::dvec3 kEye{0, -6, 0};

fish::VisibleFish fishAt(double azimuthDegrees,
                         double elevationDegrees,
                         double distance,
                         float length) {
    fish::VisibleFish fish;
    const double azimuth = azimuthDegrees * kDegree;
    fish.heading = glm::vec3(std::cos(azimuth), 0, std::sin(azimuth));
    fish.length = length;
    const glm::dvec3 middle = kEye + distance * directionAt(azimuthDegrees, elevationDegrees);
    fish.position = glm::vec3(middle) + (0.5F - fish::kNoseBodyLengths) * length * fish.heading;
    return fish;
}

fish::FishView viewOf(const std::vector<fish::VisibleFish>& fish,
                      const std::vector<std::uint8_t>& kinds = {}) {
    fish::FishView view;
    view.resize(fish.size());
    view.fish = fish;
    for (std::size_t i = 0; i < kinds.size(); ++i) view.kind[i] = kinds[i];
    return view;
}

// Open sea of 60 m with these rocks.
WallView viewThrough(const WallExtent& extent,
                     std::vector<place::Rock> rocks = {},
                     double clarity = 12) {
    place::Obstacles sight{
        .place = {.kind = config::PlaceKind::OpenSea}, .water = {}, .rocks = std::move(rocks)};
    return {extent, sight, clarity};
}

const WallPose kAhead{.eye = kEye};

TEST(WallExtent, theTheatreHasSixtyCellsOfTenDegrees) {
    EXPECT_EQ(theatre().cells(), 60U);
    EXPECT_NEAR(theatre().low().x, -60 * kDegree, 1e-6);
    EXPECT_NEAR(theatre().high().x, 60 * kDegree, 1e-6);
    EXPECT_NEAR(theatre().high().y, std::atan(1.2192 / 2.62), 1e-6);
}

TEST(WallExtent, theDeskShowsTheSameAsTheTheatre) {
    EXPECT_EQ(WallExtent(rigOf("desk")).cells(), 60U);
}

// Half a sphere is half of the 36 x 18 cells of all directions. Its edge, tilted by 30 degrees,
// crosses cells: their middles decide.
TEST(WallExtent, theDomeGoesRoundTheViewerAndOverHim) {
    const WallExtent dome(rigOf("dome_5"));
    EXPECT_NEAR(dome.low().x, -std::numbers::pi, 1e-9);
    EXPECT_NEAR(dome.high().x, std::numbers::pi, 1e-9);
    EXPECT_NEAR(dome.high().y, std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(dome.low().y, -30 * kDegree, 1e-3) << "the front, tilted down";
    EXPECT_NEAR(static_cast<double>(dome.cells()), 324, 20);
}

TEST(WallExtent, everyDirectionOnTheScreenHasItsCellAndThird) {
    const auto spot = theatre().spotOf(directionAt(-55, -22));
    ASSERT_TRUE(spot);
    EXPECT_EQ(spot->cell, 0U) << "lowest row, left";
    EXPECT_EQ(spot->third, 0U);
    EXPECT_EQ(theatre().spotOf(directionAt(55, -22))->cell, 11U);
    EXPECT_EQ(theatre().spotOf(directionAt(55, -22))->third, 2U);
    EXPECT_EQ(theatre().spotOf(directionAt(5, 0))->cell, 2U * 12 + 6);
    EXPECT_EQ(theatre().spotOf(directionAt(5, 0))->third, 1U);
    EXPECT_FALSE(theatre().spotOf(directionAt(0, 25.5))) << "above the screen";
    EXPECT_FALSE(theatre().spotOf(directionAt(61, 0))) << "beside it";
    EXPECT_FALSE(theatre().spotOf(directionAt(180, 0))) << "behind";
}

TEST(WallView, aFishIsSeenInTheCellWhereItIs) {
    const WallView eyes = viewThrough(theatre());
    const fish::FishView view = viewOf({fishAt(-55, -22, 5, 0.2F)});
    const auto seen = eyes.seen(view, 0, kAhead);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->spot.cell, 0U);
    EXPECT_NEAR(seen->angle, 0.2 / 5, 1e-5);
}

TEST(WallView, theAngleIsOfTheLengthAcrossTheLineOfSight) {
    const WallView eyes = viewThrough(theatre());
    fish::FishView view = viewOf({fishAt(0, 0, 5, 0.2F)});
    // Turned by 60 degrees about its middle: half of it is seen.
    const glm::vec3 heading{0.5F, 0, -std::sqrt(0.75F)};
    const glm::vec3 middle = view.fish[0].position - 0.115F * 0.2F * view.fish[0].heading;
    view.fish[0].heading = heading;
    view.fish[0].position = middle + 0.115F * 0.2F * heading;
    const auto half = eyes.seen(view, 0, kAhead);
    ASSERT_TRUE(half);
    EXPECT_NEAR(half->angle, 0.1 / 5, 1e-5);
    view.fish[0].heading = {0, 0, -1};
    EXPECT_FALSE(eyes.seen(view, 0, kAhead)) << "from behind";
}

TEST(WallView, whoIsSmallFarOrAwayIsNotSeen) {
    const WallView eyes = viewThrough(theatre());
    const float length = static_cast<float>(5 * kLeastAngle);
    fish::FishView view = viewOf({fishAt(0, 0, 5, 1.01F * length),
                                  fishAt(0, 0, 5, 0.99F * length),
                                  fishAt(0, 0, 11.9, 0.5F),
                                  fishAt(0, 0, 12.1, 0.5F),
                                  fishAt(0, 0, 5, 0.2F)});
    view.signs[4] = fish::kAway;
    const std::vector<SeenFish> seen = eyes.allSeen(view, kAhead);
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen[0].fish, 0U) << "half a degree";
    EXPECT_EQ(seen[1].fish, 2U) << "within the clarity of the water";
}

TEST(WallView, aRockHidesWhatIsBehindItAndNothingElse) {
    const glm::vec3 onTheLine = glm::vec3(kEye + 3.0 * directionAt(20, 0));
    const WallView eyes = viewThrough(theatre(), {{onTheLine, 0.4F, 0}});
    const fish::FishView view =
        viewOf({fishAt(20, 0, 5, 0.2F), fishAt(20, 0, 2, 0.2F), fishAt(30, 0, 5, 0.2F)});
    EXPECT_FALSE(eyes.seen(view, 0, kAhead)) << "behind";
    EXPECT_TRUE(eyes.seen(view, 1, kAhead)) << "before";
    EXPECT_TRUE(eyes.seen(view, 2, kAhead)) << "beside";
}

TEST(WallView, sandHidesWhatIsInIt) {
    place::Obstacles sight{.place = {.kind = config::PlaceKind::Reef}, .water = {}, .rocks = {}};
    const WallView eyes(theatre(), sight, 12);
    const float sand = place::floorHeight(sight.place, {0, -9});
    fish::FishView view = viewOf({fishAt(0, 0, 9, 0.2F)});
    view.fish[0].position.y = sand + 0.5F;
    EXPECT_TRUE(eyes.seen(view, 0, kAhead)) << "over it";
    view.fish[0].position.y = sand - 1;
    EXPECT_FALSE(eyes.seen(view, 0, kAhead));
}

// The submarine turns by a right angle to the left and moves: what was abeam is ahead.
TEST(WallView, thePoseIsThatOfTheSubmarineAndTheSweetSpot) {
    surroundings::Vessel vessel;
    vessel.position = {1, -5, 2};
    vessel.attitude.yaw = std::numbers::pi_v<float> / 2;
    config::Rig rig = rigOf("theatre");
    rig.sweetSpotMetres = {0, 0, 0.5};
    const WallPose pose = poseOf(vessel, rig);
    EXPECT_NEAR(pose.eye.x, 1.5, 1e-5) << "half a metre further back, away from where it looks";
    EXPECT_NEAR(pose.eye.z, 2, 1e-5);
    const glm::dvec3 ahead = pose.wallFromWorld * glm::dvec3(-1, 0, 0);
    EXPECT_NEAR(ahead.z, -1, 1e-5);
    EXPECT_NEAR(ahead.x, 0, 1e-5);
}

TEST(WallView, whoTurnsToTheSideSeesWhatIsThereAhead) {
    surroundings::Vessel vessel;
    vessel.position = glm::vec3(kEye);
    const fish::FishView view = viewOf({fishAt(-95, 0, 5, 0.2F)});
    const WallView eyes = viewThrough(theatre());
    EXPECT_FALSE(eyes.seen(view, 0, poseOf(vessel, rigOf("theatre"))));
    vessel.attitude.yaw = std::numbers::pi_v<float> / 2;
    const auto seen = eyes.seen(view, 0, poseOf(vessel, rigOf("theatre")));
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->spot.cell, 2U * 12 + 5) << "five degrees to the left";
}

TEST(Groups, fishOfASpeciesAreLinkedByGapsBelowFiveLengths) {
    std::vector<fish::VisibleFish> fish(7);
    for (fish::VisibleFish& one : fish) one.length = 0.2F;
    // A chain of three, one beyond it, one of another species within it, one away within it.
    fish[0].position = {0, 0, 0};
    fish[1].position = {1.8F, 0, 0};
    fish[2].position = {0.9F, 0, 0};
    fish[3].position = {2.9F, 0, 0};
    fish[4].position = {2.3F, 0, 0};
    fish[5].position = {0.5F, 0, 0};
    fish[6].position = {0.5F, 0, 0.9F};
    fish::FishView view = viewOf(fish, {0, 0, 0, 0, 0, 1, 1});
    view.signs[4] = fish::kAway;
    const std::vector<std::uint32_t> expected{0, 0, 0, 3, fish::kNobody, 5, 5};
    EXPECT_EQ(groupsOf(view), expected);
}

TEST(Groups, theReachIsThatOfTheMeanOfBothLengths) {
    std::vector<fish::VisibleFish> fish(2);
    fish[0].length = 0.1F;
    fish[1].length = 0.3F;
    fish[1].position = {0, 0.99F, 0};
    EXPECT_EQ(groupsOf(viewOf(fish)), (std::vector<std::uint32_t>{0, 0}));
    fish[1].position = {0, 1.01F, 0};
    EXPECT_EQ(groupsOf(viewOf(fish)), (std::vector<std::uint32_t>{0, 1}));
}

TEST(WallGlance, cellsThirdsSpeciesAndTheLargestGroupAreCounted) {
    // On the left three in one cell, two of them of a degree; in the middle one of half a degree;
    // on the right a large one of another species, and one behind the viewer.
    const float large = static_cast<float>(5 * 1.2 * kDegree);
    const float small = static_cast<float>(5 * 0.7 * kDegree);
    const fish::FishView view = viewOf({fishAt(-55, 0, 5, large),
                                        fishAt(-55, 1, 5, large),
                                        fishAt(-55, 2, 5, small),
                                        fishAt(5, 0, 5, small),
                                        fishAt(45, 0, 5, large),
                                        fishAt(180, 0, 5, large)},
                                       {0, 0, 0, 0, 1, 1});
    const WallView eyes = viewThrough(theatre());
    const WallGlance glance = glanceOf(eyes.allSeen(view, kAhead), theatre(), view, groupsOf(view));
    EXPECT_EQ(glance.inView, 5U);
    EXPECT_NEAR(glance.cellShare, 3.0 / 60, 1e-9);
    EXPECT_EQ(glance.large, (std::array<std::uint32_t, kThirds>{2, 0, 1}));
    EXPECT_EQ(glance.species, 2U);
    EXPECT_NEAR(glance.largestGroup, 3.0 / 5, 1e-9);
}

TEST(WallGlance, anEmptySeaHasNothing) {
    const fish::FishView view = viewOf({});
    const WallGlance glance = glanceOf({}, theatre(), view, groupsOf(view));
    EXPECT_EQ(glance.inView, 0U);
    EXPECT_EQ(glance.cellShare, 0);
    EXPECT_EQ(glance.largestGroup, 0);
}

}  // namespace
}  // namespace aquarama::study
