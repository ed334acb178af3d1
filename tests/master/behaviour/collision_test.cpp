// SPDX-License-Identifier: Apache-2.0
// Which fish a fish takes for a threat of collision.
#include <gtest/gtest.h>

#include "master/behaviour/perceive.h"
#include "master/behaviour/vision.h"
#include "tests/master/behaviour/aquarium.h"

namespace aquarama::behaviour {
namespace {

constexpr float kLength = 0.24F;

Senses perceived(const Aquarium& scene,
                 std::uint32_t fish,
                 const fish::Adaptation& adaptation = {}) {
    Grids grids = scene.freshGrids();
    Environment environment = scene.environment(grids);
    environment.adaptation = adaptation;
    return perceive(
        environment, scene.speciesParameters[scene.view.kind[fish]], fish, scene.minds[fish]);
}

// Two kinds that keep to themselves, in body lengths of the first.
Aquarium strangers(glm::vec3 offsetLengths) {
    Aquarium scene;
    scene.speciesParameters[0].habits.role = config::Role::Pacifist;
    fish::SpeciesParameters other;
    other.kind = 1;
    scene.speciesParameters.push_back(other);
    scene.addFish({});
    scene.addFish(offsetLengths * kLength, 1);
    return scene;
}

TEST(ShareInside, isThatOfALineInABox) {
    const Box box{1.2F, 0.5F, 0.35F, 0.4F};
    EXPECT_FLOAT_EQ(shareInside(box, {0.5F, 0, 0}, {-0.4F, 0, 0}), 1);
    EXPECT_FLOAT_EQ(shareInside(box, {1.7F, 0, 0}, {0.7F, 0, 0}), 0.5F);
    EXPECT_FLOAT_EQ(shareInside(box, {0, 0.35F, 1.4F}, {0, 0.35F, -0.6F}), 0.4F);
    EXPECT_FLOAT_EQ(shareInside(box, {2, 0, 0}, {1.3F, 0, 0}), 0);
    EXPECT_FLOAT_EQ(shareInside(box, {0, 0.36F, 0}, {0.5F, 0.36F, 0}), 0) << "above it";
    EXPECT_FLOAT_EQ(shareInside(box, {1, 1, 0}, {2, 0, 0}), 0) << "past a corner";
}

TEST(Collision, isThreatenedByWhoIsInTheBoxAhead) {
    EXPECT_TRUE(perceived(strangers({1.5F, 0, 0}), 0).collision.seen());
    EXPECT_EQ(perceived(strangers({1.5F, 0, 0}), 0).collision.object, 1U);
    EXPECT_FALSE(perceived(strangers({1.5F, 0, 1.2F}), 0).collision.seen()) << "beside the way";
    EXPECT_FALSE(perceived(strangers({1.5F, 1.2F, 0}), 0).collision.seen()) << "above it";
    EXPECT_FALSE(perceived(strangers({3.0F, 0, 0}), 0).collision.seen()) << "far ahead";
    EXPECT_FALSE(perceived(strangers({-1.5F, 0, 0}), 0).collision.seen()) << "behind";
}

// The box is enlarged for a replica, which is less agile than the biomechanical fish.
TEST(Collision, isFeltFromFartherOffWhereRegionsAreEnlarged) {
    const Aquarium scene = strangers({2.2F, 0, 0});
    EXPECT_TRUE(perceived(scene, 0, {.enlargedRegions = true}).collision.seen());
    EXPECT_FALSE(perceived(scene, 0, {.enlargedRegions = false}).collision.seen());
}

TEST(Collision, whoSwimsAwayIsNoThreat) {
    Aquarium scene = strangers({1.2F, 0, 0});
    scene.view.fish[1].speed = scene.view.fish[0].speed + 0.5F * kLength;
    EXPECT_FALSE(perceived(scene, 0).collision.seen());
}

TEST(Collision, whoIsAvoidedIsHeededForLonger) {
    Aquarium scene = strangers({2.6F, 0, 0});
    EXPECT_FALSE(perceived(scene, 0).collision.seen());
    fish::Mind avoiding = scene.minds[0];
    avoiding.intention = fish::Intention::AvoidFish;
    avoiding.target = 1;
    scene.minds[0] = avoiding;
    EXPECT_TRUE(perceived(scene, 0).collision.seen());
}

TEST(Collision, ofSeveralTheOneMostInsideThreatens) {
    Aquarium scene = strangers({2.1F, 0, 0});
    scene.addFish(glm::vec3{1.3F, 0, 0} * kLength, 1);
    EXPECT_EQ(perceived(scene, 0).collision.object, 2U);
}

TEST(Collision, aLargeBodyThreatensThoughItsMiddleIsFar) {
    Aquarium scene = strangers({-3, 1.3F, 3});
    scene.addFish(glm::vec3{3.8F, 0, 0} * kLength, 1, 1.3F);
    EXPECT_EQ(perceived(scene, 0).collision.object, 2U);
}

TEST(Collision, preyHuntersAndThoseItFollowsAreHeededOtherwise) {
    Aquarium scene = strangers({1.0F, 0, 0});
    for (std::uint64_t fish::SpeciesParameters::*relation :
         {&fish::SpeciesParameters::hunts, &fish::SpeciesParameters::shadows}) {
        scene.speciesParameters[0].*relation = 2;  // kind 1
        EXPECT_FALSE(perceived(scene, 0).collision.seen());
        scene.speciesParameters[0].*relation = 0;
    }
    EXPECT_TRUE(perceived(scene, 0).collision.seen());
    scene.speciesParameters[0].huntedBy = 2;
    EXPECT_TRUE(perceived(scene, 0).collision.seen()) << "a pacifist does not flee";
    scene.speciesParameters[0].habits.role = config::Role::Prey;
    EXPECT_FALSE(perceived(scene, 0).collision.seen()) << "prey does";
}

// A school at its spacing of 0.9 body lengths, all on one course.
TEST(Collision, inFormationSchoolmatesAreNoThreat) {
    Aquarium scene({{0, 0, 0}});
    for (const glm::vec3 place : {glm::vec3{0.9F, 0, 0.45F},
                                  glm::vec3{0.45F, 0.35F, -0.7F},
                                  glm::vec3{-0.45F, 0, 0.8F},
                                  glm::vec3{1.3F, 0, 0}})
        scene.addFish(place * kLength);
    for (std::uint32_t fish = 0; fish < scene.view.size(); ++fish)
        EXPECT_FALSE(perceived(scene, fish).collision.seen()) << fish;
}

TEST(Collision, inFormationASchoolmateOnACollisionCourseIs) {
    Aquarium scene({{0, 0, 0}, glm::vec3{0.6F, 0, 0.7F} * kLength});
    scene.head(1, {0, 0, -1});
    scene.view.fish[1].speed = 2.0F * kLength;
    scene.view.fish[0].speed = 1.0F * kLength;
    EXPECT_EQ(perceived(scene, 0).collision.object, 1U);
}

}  // namespace
}  // namespace aquarama::behaviour
