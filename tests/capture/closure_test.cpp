// SPDX-License-Identifier: Apache-2.0
// Every segment of every species can be repeated for ever: a hundred times it neither drifts nor
// rolls.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "capture/measure.h"
#include "common/base/units.h"
#include "common/motion/motor_tables.h"
#include "tests/capture/all_species.h"

namespace aquarama::capture {
namespace {

constexpr int kRepetitions = 100;

using Closed = EachSpecies;
INSTANTIATE_TEST_SUITE_P(Of,
                         Closed,
                         testing::Range(std::size_t{0}, allSpecies().size()),
                         nameOfSpecies);

TEST_P(Closed, noSegmentRollsPitchesOrClimbsButToPitch) {
    for (int action = 0; action < motion::kActions; ++action) {
        if (pitches(static_cast<motion::Action>(action))) continue;
        const ReplayedPhase end =
            replay(segment(static_cast<motion::Action>(action)), kRepetitions).back();
        const glm::dvec3 up = end.worldFromBody * glm::dvec3(0, 1, 0);
        EXPECT_LT(glm::distance(up, glm::dvec3(0, 1, 0)), 1e-6)
            << motion::nameOf(static_cast<motion::Action>(action));
        EXPECT_NEAR(end.origin.y, 0, 1e-6) << motion::nameOf(static_cast<motion::Action>(action));
    }
}

// A loop: it goes round in one plane, about the axis across it and without a drift along that, and
// a dive is the climb turned over.
TEST_P(Closed, aSlopeStaysInItsVerticalPlane) {
    using motion::Action;
    for (const Action gait : {Action::ForwardSlow, Action::ForwardMedium, Action::ForwardFast}) {
        const ReplayedPhase climbs =
            replay(segment(atGait(Action::ClimbSlow, gait)), kRepetitions).back();
        const ReplayedPhase dives =
            replay(segment(atGait(Action::DiveSlow, gait)), kRepetitions).back();
        const ReplayedPhase once = replay(segment(atGait(Action::ClimbSlow, gait)), 1).back();
        EXPECT_GT(once.origin.y, 0.01) << "it climbs";
        const glm::dquat pitched(once.worldFromBody);
        const glm::dvec3 across = glm::normalize(glm::dvec3(pitched.x, pitched.y, pitched.z));
        // The body frame sways, its nose up to 5 degrees out of the plane; the mean frame does not.
        const motion::GaitPath path = motion::pathOf(segment(atGait(Action::ClimbSlow, gait)));
        EXPECT_LT(glm::distance(glm::conjugate(path.bodyFromMean[0]) * across, glm::dvec3(0, 0, 1)),
                  1e-3)
            << "it pitches up, and neither rolls nor yaws";
        EXPECT_LT(glm::distance(climbs.worldFromBody * across, across), 1e-6);
        EXPECT_NEAR(glm::dot(climbs.origin, across), 0, 1e-6);
        EXPECT_NEAR(climbs.origin.x, dives.origin.x, 1e-6);
        EXPECT_NEAR(climbs.origin.y, -dives.origin.y, 1e-6);
        EXPECT_NEAR(climbs.origin.z, dives.origin.z, 1e-6);
    }
}

// Repeated, a curve is a circle: a hundred beats turn as far as a hundred times one, and half way
// round the fish is a diameter away.
TEST_P(Closed, aCurveGoesRoundACircle) {
    for (int i = 0; i < motion::kActions; ++i) {
        const auto action = static_cast<motion::Action>(i);
        if (!isCurve(action)) continue;
        const double turn = measure(segment(action)).turnRadians;
        EXPECT_EQ(turn > 0, action < motion::Action::CurveRightWideSlow) << motion::nameOf(action);
        const std::vector<ReplayedPhase> phases = replay(segment(action), kRepetitions);
        const glm::dvec3 heading = phases.back().worldFromBody * glm::dvec3(1, 0, 0);
        EXPECT_NEAR(
            std::remainder(std::atan2(-heading.z, heading.x) - kRepetitions * turn, 360 * kDegree),
            0,
            0.5 * kDegree)
            << motion::nameOf(action);
        const glm::dvec3 chord = phases[motion::kPhases].origin - phases.front().origin;
        const double radius = glm::length(chord) / (2 * std::sin(std::abs(turn) / 2));
        const auto half = static_cast<std::size_t>(std::lround(180 * kDegree / std::abs(turn)));
        EXPECT_NEAR(glm::length(phases[half * motion::kPhases].origin), 2 * radius, 0.03 * radius)
            << motion::nameOf(action);
    }
}

TEST_P(Closed, swimmingStraightKeepsItsCourse) {
    for (const motion::Action action : {motion::Action::ForwardSlow,
                                        motion::Action::ForwardMedium,
                                        motion::Action::ForwardFast,
                                        motion::Action::Retreat,
                                        motion::Action::Glide}) {
        // A shark does not row, so it does not back.
        if (!species().finMotion.rowing.rows() && action == motion::Action::Retreat) continue;
        const std::vector<ReplayedPhase> phases = replay(segment(action), kRepetitions);
        const glm::dvec3 course = phases[motion::kPhases].origin - phases.front().origin;
        const glm::dvec3 lastCourse =
            phases.back().origin - phases[phases.size() - 1 - motion::kPhases].origin;
        const double drift =
            std::acos(std::min(1.0, glm::dot(glm::normalize(course), glm::normalize(lastCourse))));
        EXPECT_LT(drift, 0.5 * kDegree) << motion::nameOf(action);
        EXPECT_NEAR(
            glm::length(phases.back().origin) / (kRepetitions * glm::length(course)), 1, 1e-4)
            << motion::nameOf(action);
    }
}

// A turn comes back to its course after as many repetitions as its angle says.
TEST_P(Closed, turnsAddUp) {
    for (const motion::Action action : {motion::Action::TurnLeftGradual,
                                        motion::Action::TurnLeftSharp,
                                        motion::Action::TurnRightGradual,
                                        motion::Action::TurnRightSharp}) {
        const double turn = measure(segment(action)).turnRadians;
        const ReplayedPhase end = replay(segment(action), kRepetitions).back();
        const glm::dvec3 heading = end.worldFromBody * glm::dvec3(1, 0, 0);
        const double expected = std::remainder(kRepetitions * turn, 2 * 180 * kDegree);
        EXPECT_NEAR(std::remainder(std::atan2(-heading.z, heading.x) - expected, 360 * kDegree),
                    0,
                    0.5 * kDegree)
            << motion::nameOf(action);
    }
}

// The pose goes round without a jump, also from the last phase to the first.
TEST_P(Closed, theEndOfEachCycleMeetsItsBeginning) {
    for (int action = 0; action < motion::kActions; ++action) {
        if (isStart(static_cast<motion::Action>(action))) continue;  // it ends in fast swimming
        const motion::ActionSegment& played = segment(static_cast<motion::Action>(action));
        const auto gap = [&](std::size_t from, std::size_t to) {
            double most = 0;
            for (std::size_t i = 0; i < std::size_t{body::kNodalPoints}; ++i) {
                const auto& a = played.nodes.at(from).at(i);
                const auto& b = played.nodes.at(to).at(i);
                most = std::max(most, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
            }
            return most;
        };
        double most = 0;
        for (std::size_t k = 0; k + 1 < motion::kPhases; ++k) most = std::max(most, gap(k, k + 1));
        EXPECT_LE(gap(motion::kPhases - 1, 0), most)
            << motion::nameOf(static_cast<motion::Action>(action));
    }
}

TEST_P(Closed, turnsBeginAndEndStraight) {
    double halfWidth = 0;
    for (const config::SkeletonRing& ring : species().skeleton.rings)
        halfWidth = std::max(halfWidth, ring.halfWidth);
    for (int action = 0; action < motion::kCapturedActions; ++action) {
        const motion::ActionSegment& played = segment(static_cast<motion::Action>(action));
        if (!isTurn(static_cast<motion::Action>(action))) continue;
        for (const std::size_t phase : {std::size_t{0}, std::size_t{motion::kPhases - 1}})
            for (const auto& node : played.nodes.at(phase))
                EXPECT_LT(std::abs(node[2]) * static_cast<double>(motion::kPoseUnit),
                          halfWidth + 0.03);
    }
}

TEST_P(Closed, controlPointsAreRecordedForThoseThatAskForThem) {
    for (int action = 0; action < motion::kCapturedActions; ++action)
        EXPECT_EQ(segment(static_cast<motion::Action>(action)).controlPoints.size(),
                  species().recordsControlPoints ? std::size_t{motion::kPhases} : 0U);
    EXPECT_TRUE(species().habits.shares.schooling <= 0 || species().recordsControlPoints)
        << "those that school are many";
}

// One thread, two, four: the work is shared out, the outcome is not touched by it.
TEST(Captures, giveTheSameBytesOnAnyNumberOfThreads) {
    const auto expected = motion::encodeRepertoire(allRepertoires().front());
    for (const unsigned threads : {1U, 2U, 4U}) {
        const auto outcomes = captureRepertoires({allSpecies().front()}, {.threads = threads});
        EXPECT_EQ(motion::encodeRepertoire(outcomes.front().repertoire.value()), expected)
            << threads;
    }
}

TEST(Captures, tellTheirProgressAndNameASpeciesThatFailsAndLeaveTheOthersAlone) {
    config::Species wild = allSpecies().front();
    wild.name = "wild_fish";
    wild.swim.slow.gain = std::nan("");
    double last = 0;
    const auto outcomes =
        captureRepertoires({wild, allSpecies().front()}, {.progress = [&](double share) {
                               EXPECT_GT(share, last);
                               last = share;
                           }});
    EXPECT_EQ(last, 1);
    EXPECT_FALSE(outcomes[0].repertoire);
    EXPECT_TRUE(outcomes[0].error.starts_with("wild_fish: ")) << outcomes[0].error;
    EXPECT_TRUE(outcomes[1].repertoire);
    EXPECT_EQ(outcomes[1].error, "");
}

TEST(Captures, beginNothingMoreOnceTheyAreStopped) {
    const auto outcomes = captureRepertoires(allSpecies(), {.isStopped = [] { return true; }});
    for (const CaptureOutcome& outcome : outcomes) {
        EXPECT_FALSE(outcome.repertoire);
        EXPECT_TRUE(outcome.error.ends_with("interrupted"));
    }
}

}  // namespace
}  // namespace aquarama::capture
