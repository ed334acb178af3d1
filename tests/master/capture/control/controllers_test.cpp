// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "master/capture/control/muscle_programs.h"
#include "master/capture/control/swimmer.h"
#include "tests/master/capture/control/course.h"
#include "tests/support/scad.h"

namespace aquarama {
namespace {

Order forward(const Gait& gait) {
    return {.controller = Controller::ForwardSwim, .gait = gait};
}

TEST(ForwardSwim, goesStraightOnAtItsGaitsSpeed) {
    Swimmer swimmer(scad());
    double before = 0;
    for (const Gait& gait : {scad().swim.slow, scad().swim.medium, scad().swim.fast}) {
        swimmer.give(forward(gait));
        advanceSeconds(swimmer, 8);
        const Course course = courseOver(swimmer, 1 / gait.beatHertz);
        EXPECT_GT(course.speed, 1.2 * before);
        EXPECT_NEAR(course.headingRadians, 0, 0.05);
        before = course.speed;
    }
}

TEST(Turns, headToTheirSide) {
    for (const Bend& bend : {scad().turn.gradual, scad().turn.sharp}) {
        Swimmer left(scad());
        left.give(forward(scad().swim.medium));
        advanceSeconds(left, 8);
        const double before = courseOver(left, 1 / 3.).headingRadians;
        left.give({.controller = Controller::LeftTurn, .bend = bend});
        advanceSeconds(left, secondsOf(bend, scad()) + .5);
        const double turned = courseOver(left, 0.05).headingRadians - before;
        EXPECT_GT(turned, 0.25);
    }
}

}  // namespace
}  // namespace aquarama
