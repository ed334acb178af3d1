// SPDX-License-Identifier: Apache-2.0
// What is captured, held against published figures of living fish and of the model itself.
#include "common/motion/repertoire.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/compile_segment.h"
#include "capture/measure.h"
#include "capture/speed_response.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

constexpr std::array kForward{
    motion::Action::ForwardSlow, motion::Action::ForwardMedium, motion::Action::ForwardFast};

TEST(Capture, swimsLikeAFish) {
    for (const motion::Action action : kForward) {
        const SegmentMeasures m = measure(test::segmentOf(action));
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

TEST(Capture, rightTurnsMirrorLeftOnes) {
    for (const auto& [left, right] :
         {std::pair{motion::Action::TurnLeftGradual, motion::Action::TurnRightGradual},
          std::pair{motion::Action::TurnLeftSharp, motion::Action::TurnRightSharp}}) {
        const SegmentMeasures l = measure(test::segmentOf(left));
        const SegmentMeasures r = measure(test::segmentOf(right));
        EXPECT_NEAR(l.turnRadians, -r.turnRadians, 1e-5);
        EXPECT_NEAR(l.strideBodyLengths, r.strideBodyLengths, 1e-4);
        EXPECT_NEAR(l.largestStep, r.largestStep, 1e-6);
    }
}

// The constraints that eq. 1 to 4, with their remedies, put on a pose in its own frame. A fish that
// banks, on a curve or in a turn, is in that frame turned level: in a turn its nose dips by up to a
// twentieth.
TEST(Capture, posesAreInTheirOwnBodyFrame) {
    for (std::size_t i = 0; i < motion::kActions; ++i) {
        const auto action = static_cast<motion::Action>(i);
        const motion::ActionSegment& segment = test::scadRepertoire().segments[i];
        const bool isLevel =
            isCurve(action) || isTurn(action) || isPivot(action) || action == motion::Action::Glide;
        const double noseUp = isLevel ? 0.05 / static_cast<double>(motion::kPoseUnit) : 1;
        for (const motion::NodalPose& pose : segment.nodes) {
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(pose[5][c] + pose[6][c] + pose[7][c] + pose[8][c], 0, 4);
            EXPECT_GT(pose[0][0], 0);
            EXPECT_NEAR(pose[0][1], 0, noseUp) << nameOf(action);
            EXPECT_GT(pose[5][1], 0) << "node 5 is dorsal";
            EXPECT_LT(pose[5][2], 0) << "node 5 is on the left";
        }
    }
}

TEST(Capture, controlPointsAreThoseOfThePosedCage) {
    const body::FishBody body = body::makeBody(test::scad());
    const motion::ActionSegment& segment = test::segmentOf(motion::Action::ForwardMedium);
    ASSERT_EQ(segment.controlPoints.size(), std::size_t{motion::kPhases});
    std::vector<glm::vec3> cage(body::kControlPoints);
    for (std::size_t k = 0; k < motion::kPhases; k += 9) {
        body::NodalPoints nodes{};
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (int c = 0; c < 3; ++c)
                nodes.at(i)[c] =
                    segment.nodes.at(k).at(i).at(static_cast<std::size_t>(c)) * motion::kPoseUnit;
        body::poseCage(body, nodes, cage);
        for (std::size_t i = 0; i < cage.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(cage[i][c],
                            segment.controlPoints[k].at(i).at(static_cast<std::size_t>(c)) *
                                motion::kPoseUnit,
                            3e-4);
    }
}

}  // namespace
}  // namespace aquarama::capture
