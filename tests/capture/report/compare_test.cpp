// SPDX-License-Identifier: Apache-2.0
// The measures on swimmers in closed form.
#include "capture/report/compare.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace aquarama::report {
namespace {

constexpr double kSpeed = 0.03;  // body lengths a tick
constexpr double kBeatTicks = 20;
constexpr int kTicks = 100;  // of each command

// What sets a swimmer apart from the one that goes straight along x.
struct Difference {
    double heading = 0;  // radians, from the beginning
    double speedFactor = 1;
    double turnPerTick = 0;  // radians, from the second command on
    int lateTicks = 0;       // of its beat
    glm::dvec3 offset{};     // of every nodal point
};

Script twoCommands() {
    const ScriptCommand swim{Manoeuvre::ForwardMedium, kTicks, kBeatTicks};
    return {swim, swim};
}

Trace swimmer(const Difference& difference) {
    Trace trace;
    glm::dvec3 origin{};
    double heading = difference.heading;
    for (int tick = 0; tick <= 2 * kTicks; ++tick) {
        const glm::dquat rotation = glm::angleAxis(heading, glm::dvec3(0, 1, 0));
        TracePoint point{.frame = {origin, glm::mat3_cast(rotation)}, .pose = {}};
        const double phase = 2 * std::numbers::pi * (tick - difference.lateTicks) / kBeatTicks;
        for (std::size_t i = 0; i < point.pose.size(); ++i)
            point.pose.at(i) =
                difference.offset +
                glm::dvec3(0, 0, 0.1 * std::sin(phase - 0.2 * static_cast<double>(i)));
        trace.push_back(point);
        origin += rotation * glm::dvec3(kSpeed * difference.speedFactor, 0, 0);
        if (tick >= kTicks) heading += difference.turnPerTick;
    }
    return trace;
}

CommandErrors errorsOf(const Difference& difference) {
    const Trace replica = swimmer(difference);
    return compare(twoCommands(), {swimmer({}), replica, replica}).commands.front();
}

TEST(Compare, findsNothingBetweenAFishAndItself) {
    const Comparison comparison = compare(twoCommands(), {swimmer({}), swimmer({}), swimmer({})});
    ASSERT_EQ(comparison.commands.size(), 1U);
    const CommandErrors& errors = comparison.commands.front();
    EXPECT_EQ(errors.lagTicks, 0);
    EXPECT_EQ(errors.shapeWithin, 0);
    EXPECT_EQ(errors.shapeTransition, 0);
    EXPECT_EQ(errors.shapeAsPlayed, 0);
    EXPECT_EQ(errors.agreesAfterTicks, 0);
    EXPECT_EQ(errors.pathErrorMost, 0);
    EXPECT_EQ(errors.headingError, 0);
    EXPECT_NEAR(errors.path, kTicks * kSpeed, 1e-9);
    EXPECT_EQ(comparison.openLoop.distanceMost, 0);
}

TEST(Compare, doesNotMindWhitherASwimmerSetsOut) {
    const CommandErrors errors = errorsOf({.heading = 2.1});
    EXPECT_NEAR(errors.pathErrorMost, 0, 1e-9);
    EXPECT_NEAR(errors.headingError, 0, 1e-9);
}

TEST(Compare, givesTheShareOfTheWayByWhichASlowerSwimmerLags) {
    const Trace slow = swimmer({.speedFactor = 0.9});
    const Comparison comparison = compare(twoCommands(), {swimmer({}), slow, slow});
    EXPECT_NEAR(comparison.commands.front().pathErrorAtEnd, 0.1, 1e-9);
    EXPECT_NEAR(comparison.commands.front().pathErrorAlong, -0.1, 1e-9);
    EXPECT_NEAR(comparison.commands.front().pathErrorAcross, 0, 1e-9);
    EXPECT_NEAR(comparison.openLoop.distanceAtEnd, 0.1 * kTicks * kSpeed, 1e-9);
}

TEST(Compare, givesTheDistanceBetweenAnArcAndItsTangent) {
    constexpr double kTurn = 0.5;  // radians over the command
    const CommandErrors errors = errorsOf({.turnPerTick = kTurn / kTicks});
    const double apart = std::hypot(1 - std::sin(kTurn) / kTurn, (1 - std::cos(kTurn)) / kTurn);
    EXPECT_NEAR(errors.pathErrorAtEnd, apart, 0.005);
    EXPECT_NEAR(errors.pathErrorMost, apart, 0.005);
    EXPECT_NEAR(errors.pathErrorAlong, std::sin(kTurn) / kTurn - 1, 0.005);
    EXPECT_NEAR(errors.pathErrorAcross, (1 - std::cos(kTurn)) / kTurn, 0.005);
    // The heading is that of the last beat, half a beat ago on the mean.
    EXPECT_NEAR(errors.headingError, kTurn * (1 - (kBeatTicks / 2) / kTicks), 0.01);
    EXPECT_NEAR(errors.turn, 0, 1e-9);
}

TEST(Compare, givesTheDistanceByWhichAllPointsAreOff) {
    const CommandErrors errors = errorsOf({.offset = {0.003, 0.004, 0}});
    EXPECT_NEAR(errors.shapeWithin, 0.005, 1e-9);
    EXPECT_NEAR(errors.shapeTransition, 0.005, 1e-9);
    EXPECT_EQ(errors.agreesAfterTicks, 0);
}

TEST(Compare, neverAgreesWithAShapeThatIsTooFarOff) {
    EXPECT_FALSE(errorsOf({.offset = {0.011, 0, 0}}).agreesAfterTicks.has_value());
}

TEST(Compare, findsTheLagOfABeat) {
    for (const int late : {-7, -3, 2, 9}) {
        const CommandErrors errors = errorsOf({.lateTicks = late});
        EXPECT_EQ(errors.lagTicks, late);
        EXPECT_NEAR(errors.shapeWithin, 0, 1e-9);
        // The root mean square distance of two waves of amplitude a is a sqrt(2) |sin(lag / 2)|.
        const double halfLag = std::numbers::pi * late / kBeatTicks;
        EXPECT_NEAR(errors.shapeAsPlayed, 0.1 * std::sqrt(2.0) * std::abs(std::sin(halfLag)), 1e-4);
    }
}

TEST(Compare, summarisesShapesByTimeAndPathsByCommand) {
    CommandErrors brief;
    brief.command = {Manoeuvre::ForwardSlow, 40, 20};
    brief.shapeWithin = 0.03;
    brief.pathErrorAtEnd = 0.2;
    CommandErrors lasting;
    lasting.command = {Manoeuvre::ForwardSlow, 80, 20};
    lasting.pathErrorAtEnd = 0.1;
    const std::vector<CommandErrors> commands{brief, lasting, lasting};
    const Summary summary = summarise(commands);
    EXPECT_EQ(summary.commands, 3U);
    EXPECT_NEAR(summary.shapeWithin, 0.03 * std::sqrt(20.0 / 140.0), 1e-12);
    EXPECT_EQ(summary.pathErrorMedian, 0.1);
    EXPECT_EQ(summary.pathErrorNinth, 0.2);
    EXPECT_EQ(summary.pathErrorWorst, 0.2);
}

// A roll is in the frame of the fish, and in the poses of a replica whose captured path is level.
TEST(Compare, takesARollInTheFrameAndOneInThePosesForTheSameInTurnsAndCurves) {
    const glm::dquat roll = glm::angleAxis(0.4, glm::dvec3(1, 0, 0));
    Trace inFrame = swimmer({.heading = 0.3});
    Trace inPoses = inFrame;
    for (TracePoint& point : inFrame) point.frame.worldFromBody *= glm::mat3_cast(roll);
    for (TracePoint& point : inPoses)
        for (glm::dvec3& node : point.pose) node = roll * node;
    const auto shapeIn = [&](Manoeuvre manoeuvre) {
        const Script script{{Manoeuvre::ForwardMedium, kTicks, kBeatTicks},
                            {manoeuvre, kTicks, kBeatTicks}};
        return compare(script, {inFrame, inPoses, inPoses}).commands.front().shapeWithin;
    };
    EXPECT_NEAR(shapeIn(Manoeuvre::TurnLeftSharp), 0, 1e-9);
    EXPECT_NEAR(shapeIn(Manoeuvre::CurveRight), 0, 1e-9);
    EXPECT_GT(shapeIn(Manoeuvre::ForwardMedium), 0.01);
}

TEST(Compare, measuresACommandInOnePlaceByBodyLengths) {
    const Script script{{Manoeuvre::ForwardMedium, kTicks, kBeatTicks},
                        {Manoeuvre::Hover, kTicks, kBeatTicks}};
    const Trace slow = swimmer({.speedFactor = 0.9});
    const CommandErrors errors = compare(script, {swimmer({}), slow, slow}).commands.front();
    EXPECT_NEAR(errors.pathErrorAtEnd, 0.1 * kTicks * kSpeed, 1e-9);
    EXPECT_NEAR(errors.pathErrorAlong, -0.1 * kTicks * kSpeed, 1e-9);
}

}  // namespace
}  // namespace aquarama::report
