// SPDX-License-Identifier: Apache-2.0
// The controllers that work with the muscles: forward swim, the turns, glide.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/motor_controllers.h"
#include "capture/swimmer.h"
#include "tests/capture/course.h"
#include "tests/support/all_species.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

// As the species' fish is in the middle of a beat: the longest it goes before a test looks at it.
constexpr double kTailRunUpBeats = 16;

double oneBeat(const config::Species& species) {
    return 1 / species.swim.medium.beatHertz;
}

TEST(ForwardSwim, goesStraightOnAndFasterFromGaitToGaitInEverySpecies) {
    for (const config::Species& species : test::allSpecies()) {
        Swimmer swimmer(species);
        double before = 0.1;
        for (const config::Gait& gait :
             {species.swim.slow, species.swim.medium, species.swim.fast}) {
            swimmer.give(forward(gait));
            advanceSeconds(swimmer, kTailRunUpBeats / gait.beatHertz);
            const Course course = courseOver(swimmer, 1 / gait.beatHertz);
            EXPECT_GT(course.velocity.x, 1.1 * before) << species.name;
            EXPECT_NEAR(course.towardsRadians, 0, 8 * kDegree) << species.name;
            // Fins that row are not quite even.
            EXPECT_LT(course.mostRollRadians, gait.rows > 0 ? 1e-3 : 1e-6) << species.name;
            before = course.velocity.x;
            if (gait.rows > 0) swimmer = Swimmer(species);
        }
    }
}

TEST(ForwardSwim, keepsTimeOverAChangeOfGait) {
    const config::Gait brisk{.beatHertz = 3, .gain = 1};
    const config::Gait lazy{.beatHertz = 3, .gain = 0.3};
    Swimmer steady(test::scad());
    Swimmer changing(test::scad());
    steady.give(forward(brisk));
    changing.give(forward(brisk));
    for (int beat = 0; beat < 8; ++beat) {
        changing.give(forward(beat % 2 == 0 ? lazy : brisk));
        advanceSeconds(changing, 0.217);
    }
    changing.give(forward(brisk));
    advanceSeconds(changing, 20 - changing.seconds());
    advanceSeconds(steady, 20);
    const NodeVectors a = inBodyFrame(steady.state().positions);
    const NodeVectors b = inBodyFrame(changing.state().positions);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(glm::distance(a.at(i), b.at(i)), 1e-3);
}

// From the mean heading of one beat to that after the turn, left positive.
double turnedBy(const config::Species& species,
                Controller controller,
                const config::Bend& bend,
                double beats) {
    Swimmer swimmer = swimming(species, beats);
    const double before = courseOver(swimmer, oneBeat(species)).meanHeadingRadians;
    swimmer.give({.controller = controller, .bend = bend});
    advanceSeconds(swimmer, secondsOf(bend, species));
    return bodyAnglesOf(swimmer.state()).headingRadians - before;
}

TEST(LeftTurn, turnsLeftAndSharperWithTheSharpBendInEverySpecies) {
    for (const config::Species& species : test::allSpecies()) {
        const auto turned = [&](const config::Bend& bend) {
            return turnedBy(species, Controller::LeftTurn, bend, kTailRunUpBeats);
        };
        const double gradual = turned(species.turn.gradual);
        EXPECT_GT(gradual, 10 * kDegree) << species.name;
        EXPECT_GT(turned(species.turn.sharp), gradual + 10 * kDegree) << species.name;
    }
}

TEST(RightTurn, isTheLeftTurnsMirrorImageHalfABeatLater) {
    for (const config::Species& species : test::allSpecies()) {
        const config::Bend& bend = species.turn.sharp;
        const double left = turnedBy(species, Controller::LeftTurn, bend, kTailRunUpBeats);
        const double right = turnedBy(species, Controller::RightTurn, bend, kTailRunUpBeats + 0.5);
        // The first beat of all goes left, so that the two paths lie a little askew.
        EXPECT_NEAR(right, -left, 1 * kDegree) << species.name;
        EXPECT_LT(right, -20 * kDegree) << species.name;
    }
}

TEST(Turns, endWithTheMusclesRelaxed) {
    Swimmer swimmer = swimming(test::scad(), kTailRunUpBeats);
    swimmer.give({.controller = Controller::RightTurn, .bend = test::scad().turn.sharp});
    advanceSeconds(swimmer, secondsOf(test::scad().turn.sharp, test::scad()) + 2);
    const NodeVectors straight = inBodyFrame(makeBiomechanicalFish(test::scad()).restPositions);
    const NodeVectors pose = inBodyFrame(swimmer.state().positions);
    for (std::size_t i = 0; i < pose.size(); ++i)
        EXPECT_LT(glm::distance(pose.at(i), straight.at(i)), 0.01);
}

TEST(Glide, slowsWithoutEndAndWithoutTurningBackInEverySpecies) {
    for (const config::Species& species : test::allSpecies()) {
        Swimmer swimmer = swimming(species, kTailRunUpBeats);
        swimmer.give({.controller = Controller::Glide});
        double speed = courseOver(swimmer, oneBeat(species)).velocity.x;
        for (int i = 0; i < 8; ++i) {
            const Course course = courseOver(swimmer, oneBeat(species));
            EXPECT_LT(course.velocity.x, speed) << species.name;
            EXPECT_GT(course.velocity.x, 0.5 * speed) << species.name << " goes on";
            EXPECT_NEAR(course.towardsRadians, 0, 16 * kDegree) << species.name;
            speed = course.velocity.x;
        }
    }
}

TEST(Orders, neverMakeTheBodyJump) {
    Swimmer swimmer = swimming(test::scad(), kTailRunUpBeats);
    const double swum = [&] {
        double most = 0;
        for (int i = 0; i < 240; ++i) {
            const NodeVectors before = swimmer.state().velocities;
            swimmer.advance(1);
            for (std::size_t node = 0; node < before.size(); ++node)
                most = std::max(
                    most, glm::distance(before.at(node), swimmer.state().velocities.at(node)));
        }
        return most;
    }();
    const config::Gait& medium = test::scad().swim.medium;
    for (const Order& order :
         {Order{.controller = Controller::LeftTurn, .bend = test::scad().turn.sharp},
          Order{.controller = Controller::RightTurn, .bend = test::scad().turn.sharp},
          forward(test::scad().swim.slow),
          Order{.controller = Controller::Brake},
          Order{.controller = Controller::Retreat, .gait = medium},
          forward(medium)}) {
        swimmer.give(order);
        for (int i = 0; i < 100; ++i) {
            const NodeVectors before = swimmer.state().velocities;
            swimmer.advance(1);
            for (std::size_t node = 0; node < before.size(); ++node)
                EXPECT_LT(glm::distance(before.at(node), swimmer.state().velocities.at(node)),
                          4 * swum);
        }
    }
}

}  // namespace
}  // namespace aquarama::capture
