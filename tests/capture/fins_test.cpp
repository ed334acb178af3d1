// SPDX-License-Identifier: Apache-2.0
// The controllers that work with the pectoral fins: ascend, descend, balance, brake, retreat.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/swimmer.h"
#include "tests/capture/course.h"
#include "tests/support/all_species.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

constexpr double kRunUpBeats = 16;
constexpr int kSettleBeats = 30;

Order with(Controller controller, const config::Species& species, double pitchRadians = 0) {
    return {.controller = controller, .gait = species.swim.medium, .pitchRadians = pitchRadians};
}

Course overBeats(Swimmer& swimmer, const config::Species& species, int beats) {
    return courseOver(swimmer, beats / species.swim.medium.beatHertz);
}

// The same fish, rolled about its axis; positive: right side up.
Swimmer rolled(const config::Species& species, double radians) {
    BiomechanicalFish fish = makeBiomechanicalFish(species);
    for (glm::dvec3& x : fish.restPositions)
        x = {x.x,
             std::cos(radians) * x.y + std::sin(radians) * x.z,
             -std::sin(radians) * x.y + std::cos(radians) * x.z};
    return {fish, species, longestStepSeconds(fish)};
}

TEST(AscendAndDescend, holdThePitchThatIsAskedForAndRiseOrFallInEverySpecies) {
    const double pitch = 30 * kDegree;
    for (const config::Species& species : test::allSpecies()) {
        Swimmer up = swimming(species, kRunUpBeats);
        up.give(with(Controller::Ascend, species, pitch));
        overBeats(up, species, kSettleBeats);
        const Course rise = overBeats(up, species, 4);
        EXPECT_NEAR(rise.meanPitchRadians, pitch, 4 * kDegree) << species.name;
        EXPECT_NEAR(std::atan2(rise.velocity.y, rise.velocity.x), pitch, 5 * kDegree)
            << species.name << ": it goes where it looks";
        EXPECT_LT(rise.mostRollRadians, 5 * kDegree) << species.name;

        Swimmer down = swimming(species, kRunUpBeats);
        down.give(with(Controller::Descend, species, pitch));
        overBeats(down, species, kSettleBeats);
        const Course fall = overBeats(down, species, 4);
        EXPECT_NEAR(fall.velocity.y, -rise.velocity.y, 1e-3) << "one is the other's image";
    }
}

TEST(Balance, levelsAFishThatWasClimbingInEverySpecies) {
    for (const config::Species& species : test::allSpecies()) {
        Swimmer swimmer = swimming(species, kRunUpBeats);
        swimmer.give(with(Controller::Ascend, species, 30 * kDegree));
        overBeats(swimmer, species, 10);
        swimmer.give(with(Controller::Balance, species));
        overBeats(swimmer, species, kSettleBeats);
        const Course course = overBeats(swimmer, species, 4);
        EXPECT_NEAR(course.meanPitchRadians, 0, 1 * kDegree) << species.name;
        EXPECT_NEAR(course.velocity.y, 0, 0.02) << species.name;
    }
}

TEST(Balance, rightsAFishThatLeansToEitherSideInEverySpecies) {
    for (const config::Species& species : test::allSpecies())
        for (const double roll : {40 * kDegree, -40 * kDegree}) {
            Swimmer swimmer = rolled(species, roll);
            EXPECT_NEAR(bodyAnglesOf(swimmer.state()).rollRadians, roll, 1e-9);
            swimmer.give(with(Controller::Balance, species));
            overBeats(swimmer, species, kSettleBeats);
            EXPECT_LT(overBeats(swimmer, species, 4).mostRollRadians, 5 * kDegree) << species.name;
        }
}

TEST(Balance, isWhatRightsIt) {
    Swimmer swimmer = rolled(test::scad(), 40 * kDegree);
    swimmer.give(forward(test::scad().swim.medium));
    overBeats(swimmer, test::scad(), kSettleBeats);
    EXPECT_GT(bodyAnglesOf(swimmer.state()).rollRadians, 35 * kDegree);
}

TEST(Brake, stopsAFishWithoutASwerveWhereAGlideGoesOnInEverySpecies) {
    for (const config::Species& species : test::allSpecies()) {
        Swimmer braking = swimming(species, kRunUpBeats);
        Swimmer gliding = swimming(species, kRunUpBeats);
        const double before = overBeats(braking, species, 1).velocity.x;
        overBeats(gliding, species, 1);
        braking.give({.controller = Controller::Brake});
        gliding.give({.controller = Controller::Glide});
        double speed = before;
        for (int i = 0; i < 6; ++i) {
            const double now = overBeats(braking, species, 1).velocity.x;
            EXPECT_LT(now, speed) << species.name;
            EXPECT_LT(now, overBeats(gliding, species, 1).velocity.x) << species.name;
            EXPECT_GT(now, -0.01) << species.name << " does not bounce back";
            speed = now;
        }
        EXPECT_LT(speed, 0.25 * before) << species.name;
        EXPECT_NEAR(bodyAnglesOf(braking.state()).headingRadians, 0, 10 * kDegree) << species.name;
    }
}

TEST(Retreat, swimsBackwardInEverySpeciesThatRows) {
    for (const config::Species& species : test::allSpecies()) {
        if (!species.finMotion.rowing.rows()) continue;
        Swimmer swimmer(species);
        swimmer.give(with(Controller::Retreat, species));
        overBeats(swimmer, species, kSettleBeats);
        const Course course = overBeats(swimmer, species, 4);
        EXPECT_LT(course.alongBody, -0.1) << species.name;
        EXPECT_NEAR(course.meanHeadingRadians, 0, 1 * kDegree) << species.name;
    }
}

// Tail first a fish is a weathercock the wrong way round.
TEST(Retreat, holdsItsHeadingThoughTheFishIsNotSymmetric) {
    BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    for (WettedFace& face : fish.faces)
        if (face.nodes[0] % 4 == 0) face.drag *= 1.1;
    Swimmer swimmer(fish, test::scad(), longestStepSeconds(fish));
    swimmer.give(with(Controller::Retreat, test::scad()));
    const Course course = overBeats(swimmer, test::scad(), 60);
    EXPECT_LT(course.velocity.x, -0.3);
    EXPECT_NEAR(course.meanHeadingRadians, 0, 10 * kDegree);
    EXPECT_LT(course.mostRollRadians, 10 * kDegree);
}

}  // namespace
}  // namespace aquarama::capture
