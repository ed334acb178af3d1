// SPDX-License-Identifier: Apache-2.0

#include "capture/report/take.h"

#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/motion/motor_tables.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

class TakeOf : public testing::TestWithParam<int> {
  protected:
    motion::Action action_ = static_cast<motion::Action>(GetParam());
    const motion::ActionSegment& segment_ = test::segmentOf(action_);
};
INSTANTIATE_TEST_SUITE_P(
    Segments, TakeOf, testing::Range(0, motion::kCapturedActions), [](const auto& asked) {
        return std::string(motion::nameOf(static_cast<motion::Action>(asked.param)));
    });

TEST_P(TakeOf, atThePhasesItIsTheReplayInMetresAndTurned) {
    const Take take = takeAtPhases(test::scadRepertoire(), action_, 3, motion::kPhases);
    const auto replayed = capture::replay(segment_, 3);
    const glm::dquat turned = glm::conjugate(motion::pathOf(segment_).bodyFromMean[0]);
    ASSERT_EQ(take.frames.size(), replayed.size());
    for (std::size_t k = 0; k < replayed.size(); ++k) {
        for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
            const glm::dvec3 expected = turned * replayed[k].nodes.at(i) * take.lengthMetres;
            EXPECT_LT(glm::distance(take.frames[k].nodes.at(i), expected), 1e-9);
        }
    }
}

TEST_P(TakeOf, aTickIsOnTheStraightLineBetweenThePhasesAroundIt) {
    const Take take = takeAtTicks(test::scadRepertoire(), action_, 2);
    const Take fine = takeAtPhases(test::scadRepertoire(), action_, 2, motion::kPhases);
    const double phasesInTick =
        motion::kPhases / (static_cast<double>(segment_.periodSeconds) * 60.0);
    for (std::size_t tick = 0; tick < take.frames.size(); ++tick) {
        const auto k =
            std::min(static_cast<std::size_t>(static_cast<double>(tick) * phasesInTick + 1e-6),
                     fine.frames.size() - 2);
        const TakeFrame& before = fine.frames[k];
        const TakeFrame& after = fine.frames[k + 1];
        for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
            const glm::dvec3 node = take.frames[tick].nodes.at(i);
            const double step = glm::distance(before.nodes.at(i), after.nodes.at(i));
            EXPECT_NEAR(
                glm::distance(before.nodes.at(i), node) + glm::distance(node, after.nodes.at(i)),
                step,
                1e-7);
        }
    }
}

TEST_P(TakeOf, startsAtTheOriginAndLasts) {
    const Take take = takeAtTicks(test::scadRepertoire(), action_, 2);
    EXPECT_EQ(take.frames.front().origin, glm::dvec3(0));
    EXPECT_LE(take.frames.back().seconds, 2 * static_cast<double>(segment_.periodSeconds) + 1e-6);
    EXPECT_GT(take.frames.back().seconds + 1 / 60.0,
              2 * static_cast<double>(segment_.periodSeconds));
}

TEST(Take, swimmingGoesAlongXAndStaysLevel) {
    for (const motion::Action action : {motion::Action::ForwardSlow,
                                        motion::Action::ForwardMedium,
                                        motion::Action::ForwardFast}) {
        const glm::dvec3 end =
            takeAtPhases(test::scadRepertoire(), action, 100, 1).frames.back().origin;
        EXPECT_GT(end.x, 0);
        EXPECT_LT(std::abs(end.y) / end.x, 1e-3) << motion::nameOf(action);
        EXPECT_LT(std::abs(end.z) / end.x, 0.02) << motion::nameOf(action);
    }
}

TEST(Take, aLeftTurnEndsToTheLeft) {
    const TakeFrame end =
        takeAtPhases(test::scadRepertoire(), motion::Action::TurnLeftSharp, 1, 1).frames.back();
    EXPECT_LT(end.origin.z, 0) << "z is to the right";
    EXPECT_LT((end.worldFromBody * glm::dvec3(1, 0, 0)).z, -0.5);
}

TEST(Take, moreFramesThanAFileCanCountAreRefused) {
    EXPECT_THROW(
        static_cast<void>(takeAtTicks(test::scadRepertoire(), motion::Action::TurnLeftSharp, 2000)),
        Error);
}

TEST(Markers, haveLabelsOfTheirOwnThatAreShortEnough) {
    std::set<std::string> labels;
    for (std::size_t node = 0; node < body::kNodalPoints; ++node) {
        labels.insert(markerLabel(node));
        EXPECT_LE(markerLabel(node).size(), 16U);
    }
    EXPECT_EQ(labels.size(), static_cast<std::size_t>(body::kNodalPoints));
    EXPECT_EQ(markerLabel(7), "R2_VR");
    EXPECT_EQ(markerDescription(22), "nodal point 22, ventral tip of the tail");
}

}  // namespace
}  // namespace aquarama::report
