// SPDX-License-Identifier: Apache-2.0
// What is captured, held against published figures of living fish and of the model itself.
#include "common/motion/repertoire.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "master/capture/measure/measure.h"
#include "tests/support/scad.h"

namespace aquarama {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;

struct Expected {
    Action action;
    double beatHertz;
    double speed;  // body lengths a second, of the independent prototype of this model
};
constexpr std::array kForward{Expected{Action::ForwardSlow, 2, 1.007},
                              Expected{Action::ForwardMedium, 3, 1.958},
                              Expected{Action::ForwardFast, 5, 2.624}};
constexpr std::array kTurns{Action::TurnLeftGradual,
                            Action::TurnLeftSharp,
                            Action::TurnRightGradual,
                            Action::TurnRightSharp};

TEST(Capture, swimsAsFastAsThePrototype) {
    for (const Expected& expected : kForward) {
        const SegmentMeasures m = measure(segmentOf(expected.action));
        EXPECT_NEAR(m.speedBodyLengths / expected.speed, 1, 0.05) << nameOf(expected.action);
        EXPECT_NEAR(1 / m.periodSeconds, expected.beatHertz, 1e-5);
    }
}

TEST(Capture, swimsLikeAFish) {
    for (const Expected& expected : kForward) {
        const SegmentMeasures m = measure(segmentOf(expected.action));
        // Taylor, Nudds & Thomas 2003; Videler & Wardle 1991 (the slow gait has less amplitude,
        // hence less stride); Bainbridge 1958.
        EXPECT_GT(m.strouhal, 0.2);
        EXPECT_LT(m.strouhal, 0.4);
        EXPECT_GT(m.strideBodyLengths, 0.48);
        EXPECT_LT(m.strideBodyLengths, 0.72);
        EXPECT_LT(m.tailAmplitude, 0.22);
        EXPECT_LT(m.noseAmplitude, 0.3 * m.strideBodyLengths);
        EXPECT_LT(m.noseAmplitude, 0.5 * m.tailAmplitude);
    }
}

TEST(Capture, aHundredStraightCyclesNeitherTurnNorRollNorClimb) {
    for (const Expected& expected : kForward) {
        const ReplayedPhase end = replay(segmentOf(expected.action), 100).back();
        const glm::dvec3 forward = end.worldFromBody * glm::dvec3(1, 0, 0);
        const glm::dvec3 up = end.worldFromBody * glm::dvec3(0, 1, 0);
        EXPECT_LT(glm::distance(forward, glm::dvec3(1, 0, 0)), 1e-4);
        EXPECT_LT(glm::distance(up, glm::dvec3(0, 1, 0)), 1e-6);
        EXPECT_NEAR(end.origin.y, 0, 1e-6);
        // On one line: half-way it is at half the way.
        const ReplayedPhase half = replay(segmentOf(expected.action), 50).back();
        EXPECT_LT(glm::distance(end.origin, 2.0 * half.origin), 1e-3 * glm::length(end.origin));
    }
}

TEST(Capture, aHundredTurnsNeitherRollNorPitchNorClimb) {
    for (const Action action : kTurns) {
        const ReplayedPhase end = replay(segmentOf(action), 100).back();
        EXPECT_LT(glm::distance(end.worldFromBody * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)),
                  1e-6);
        EXPECT_NEAR(end.origin.y, 0, 1e-6);
    }
}

TEST(Capture, turnsGoToTheirSideAndSharpOnesFurther) {
    for (const Action action : kTurns) {
        const bool isSharp = action == Action::TurnLeftSharp || action == Action::TurnRightSharp;
        const bool isLeft = action <= Action::TurnLeftSharp;
        const double left = (isLeft ? 1 : -1) * measure(segmentOf(action)).turnRadians;
        EXPECT_GT(left, (isSharp ? 40 : 19) * kDegree) << nameOf(action);
        EXPECT_LT(left, (isSharp ? 80 : 40) * kDegree) << nameOf(action);
        EXPECT_TRUE(segmentOf(action).playsToEnd);
    }
}

TEST(Capture, rightTurnsMirrorLeftOnes) {
    for (const auto& [left, right] : {std::pair{Action::TurnLeftGradual, Action::TurnRightGradual},
                                      std::pair{Action::TurnLeftSharp, Action::TurnRightSharp}}) {
        const SegmentMeasures l = measure(segmentOf(left));
        const SegmentMeasures r = measure(segmentOf(right));
        EXPECT_NEAR(l.turnRadians, -r.turnRadians, 1e-5);
        EXPECT_NEAR(l.strideBodyLengths, r.strideBodyLengths, 1e-4);
        EXPECT_NEAR(l.largestStep, r.largestStep, 1e-6);
    }
}

// The pose goes round without a jump, also from the last phase to the first.
TEST(Capture, theEndOfEachCycleMeetsItsBeginning) {
    for (const ActionSegment& segment : scadRepertoire().segments) {
        const auto gap = [&](std::size_t from, std::size_t to) {
            double most = 0;
            for (std::size_t i = 0; i < std::size_t{kNodalPoints}; ++i) {
                const auto& a = segment.nodes.at(from).at(i);
                const auto& b = segment.nodes.at(to).at(i);
                most = std::max(most, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
            }
            return most;
        };
        double most = 0;
        for (std::size_t k = 0; k + 1 < kPhases; ++k) most = std::max(most, gap(k, k + 1));
        EXPECT_LE(gap(kPhases - 1, 0), most);
    }
}

TEST(Capture, aTurnBeginsAndEndsStraight) {
    for (const Action action : kTurns)
        for (const std::size_t phase : {std::size_t{0}, std::size_t{kPhases - 1}})
            for (const auto& node : segmentOf(action).nodes.at(phase))
                EXPECT_LT(std::abs(node[2]) * static_cast<double>(kPoseUnit),
                          0.051 + 0.03);  // half-width of ring 2
}

// The constraints that eq. 1 to 4, with their remedies, put on a pose in its own frame.
TEST(Capture, posesAreInTheirOwnBodyFrame) {
    for (const ActionSegment& segment : scadRepertoire().segments) {
        for (const NodalPose& pose : segment.nodes) {
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(pose[5][c] + pose[6][c] + pose[7][c] + pose[8][c], 0, 4);
            EXPECT_GT(pose[0][0], 0);
            EXPECT_NEAR(pose[0][1], 0, 1);
            EXPECT_GT(pose[5][1], 0) << "node 5 is dorsal";
            EXPECT_LT(pose[5][2], 0) << "node 5 is on the left";
        }
    }
}

TEST(Capture, controlPointsAreThoseOfThePosedCage) {
    const FishBody body = makeBody(scad());
    const ActionSegment& segment = segmentOf(Action::ForwardMedium);
    ASSERT_EQ(segment.controlPoints.size(), std::size_t{kPhases});
    std::vector<glm::vec3> cage(kControlPoints);
    for (std::size_t k = 0; k < kPhases; k += 9) {
        NodalPoints nodes{};
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (int c = 0; c < 3; ++c)
                nodes.at(i)[c] =
                    segment.nodes.at(k).at(i).at(static_cast<std::size_t>(c)) * kPoseUnit;
        poseCage(body, nodes, cage);
        for (std::size_t i = 0; i < cage.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(
                    cage[i][c],
                    segment.controlPoints[k].at(i).at(static_cast<std::size_t>(c)) * kPoseUnit,
                    3e-4);
    }
}

TEST(Capture, givesTheSameBytesTwiceAndTellsItsProgress) {
    double last = 0;
    const Repertoire again = captureRepertoire(scad(), [&](double share) {
        EXPECT_GE(share, last);
        last = share;
    });
    EXPECT_EQ(encodeRepertoire(again), encodeRepertoire(scadRepertoire()));
    EXPECT_NEAR(last, 1, 1e-9);
}

}  // namespace
}  // namespace aquarama
