// SPDX-License-Identifier: Apache-2.0
// Eq. 6 and 7 on a fish that keeps its shape and goes where it is told: what compile*() makes of
// known increments of the body frame. Each function keeps those that have its symmetry, whatever
// the attitude in which the fish begins.
#include <cmath>
#include <functional>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "capture/compile_segment.h"
#include "capture/dynamics.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

constexpr auto kCount = std::size_t{motion::kPhases};
constexpr glm::dvec3 kRoll{1, 0, 0};
constexpr glm::dvec3 kYaw{0, 1, 0};
constexpr glm::dvec3 kPitch{0, 0, 1};

// A change of the body frame, in the body frame at its start: B' = B * step.
struct Step {
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 translation{};
};
using Steps = std::array<Step, kCount>;

glm::dquat turnedBy(double radians, const glm::dvec3& axis) {
    return glm::angleAxis(radians, axis);
}

// `of` is called with 0 to 63.
Steps steps(const std::function<Step(double)>& of) {
    Steps all;
    for (std::size_t k = 0; k < kCount; ++k) all.at(k) = of(static_cast<double>(k));
    return all;
}

// Nodal points at rest in the body frame.
const NodeVectors& shape() {
    static const NodeVectors kShape =
        inBodyFrame(makeBiomechanicalFish(test::scad()).restPositions);
    return kShape;
}

// Neither level nor upright, and not on the world's axes.
glm::dquat askew() {
    return turnedBy(2.1, kYaw) * turnedBy(0.6, kPitch) * turnedBy(-0.9, kRoll);
}

// What the fish does from `start` on, as a recording of its nodal points in the world.
RecordedCycle recordingOf(const Steps& steps,
                          const glm::dquat& start,
                          const glm::dvec3& course = {1, 0, 0}) {
    RecordedCycle recording{.periodSeconds = 0.5, .course = course, .poses = {}, .fins = {}};
    glm::dquat rotation = start;
    glm::dvec3 origin{3, -2, 5};
    for (std::size_t k = 0; k <= kCount; ++k) {
        NodeVectors pose{};
        for (std::size_t i = 0; i < pose.size(); ++i)
            pose.at(i) = origin + rotation * shape().at(i);
        recording.poses.push_back(pose);
        if (k == kCount) break;
        origin += rotation * steps.at(k).translation;
        rotation = rotation * steps.at(k).rotation;
    }
    return recording;
}

// To the rounding of the floats in which increments are kept.
void expectSteps(const motion::FrameIncrements& increments,
                 const Steps& steps,
                 std::size_t from = 0) {
    constexpr double kRounding = 2e-7;
    for (std::size_t k = from; k < kCount; ++k) {
        const glm::dquat rotation(increments.at(k).rotation);
        const glm::dvec3 translation(increments.at(k).translation);
        const glm::dquat off = glm::conjugate(steps.at(k).rotation) * rotation;
        ASSERT_LT(glm::length(glm::dvec3(off.x, off.y, off.z)), kRounding) << "phase " << k;
        ASSERT_LT(glm::distance(translation, steps.at(k).translation), kRounding) << "phase " << k;
    }
}

// Eq. 8: in every phase the same nodal points in the body frame, turned about its x axis.
void expectShape(const motion::ActionSegment& segment, double rollRadians = 0) {
    for (std::size_t k = 0; k < kCount; ++k)
        for (std::size_t i = 0; i < shape().size(); ++i) {
            const auto& at = segment.nodes.at(k).at(i);
            const glm::dvec3 point =
                static_cast<double>(motion::kPoseUnit) * glm::dvec3(at[0], at[1], at[2]);
            ASSERT_LT(glm::distance(point, turnedBy(rollRadians, kRoll) * shape().at(i)), 4e-5)
                << "phase " << k << ", node " << i;
        }
}

// Half a beat later the mirror image, left and right exchanged.
Steps withMirroredHalf(const std::function<Step(double)>& of) {
    return steps([&](double k) {
        if (k < kCount / 2) return of(k);
        const auto [q, way] = of(k - kCount / 2);
        return Step{{q.w, -q.x, -q.y, q.z}, {way.x, way.y, -way.z}};
    });
}

Step rollingYawingAndPitching(double k) {
    return {turnedBy(0.03 * std::sin(k), kRoll) * turnedBy(0.05 * std::cos(2 * k), kYaw) *
                turnedBy(0.01 + 0.02 * std::sin(3 * k + 1), kPitch),
            {0.01 + 0.001 * std::cos(k), 0.002 * std::sin(k + 2), 0.004 * std::cos(3 * k)}};
}

TEST(Compile, aSlopeKeepsEveryStepOfAMotionThatIsMirroredHalfABeatLater) {
    const Steps known = withMirroredHalf(rollingYawingAndPitching);
    const motion::ActionSegment segment = compileSlope(recordingOf(known, askew()));
    expectSteps(segment.increments, known);
    expectShape(segment);
    EXPECT_EQ(segment.periodSeconds, 0.5F);
}

TEST(Compile, aSlopeTakesTheMeanOfAStepAndOfItsMirrorImageHalfABeatLater) {
    const Steps known = steps([](double k) {
        return Step{turnedBy(k < kCount / 2 ? 0.02 : 0.01, kPitch), {0.01, 0, 0.003}};
    });
    const Steps mean = steps([](double) { return Step{turnedBy(0.015, kPitch), {0.01, 0, 0}}; });
    expectSteps(compileSlope(recordingOf(known, askew())).increments, mean);
}

TEST(Compile, aGaitKeepsEveryStepInItsOwnPlaneAndNoneOutOfIt) {
    const auto inPlane = [](double k) {
        return Step{turnedBy(0.05 * std::sin(2 * k), kYaw), {0.01, 0, 0.004 * std::cos(k)}};
    };
    const Steps known = withMirroredHalf(inPlane);
    const motion::ActionSegment segment = compileForward(recordingOf(known, askew()));
    expectSteps(segment.increments, known);
    expectShape(segment);
    const Steps climbs = steps([](double) { return Step{{1, 0, 0, 0}, {0.01, 0.003, 0}}; });
    const Steps goes = steps([](double) { return Step{{1, 0, 0, 0}, {0.01, 0, 0}}; });
    expectSteps(compileForward(recordingOf(climbs, askew())).increments, goes);
}

TEST(Compile, aFastStartKeepsEveryStepInItsOwnPlane) {
    const Steps known = steps([](double k) {
        return Step{turnedBy(0.06 * std::cos(0.1 * k), kYaw),
                    {0.0003 * k, 0, 0.004 * std::sin(0.2 * k)}};
    });
    const motion::ActionSegment segment = compileStart(recordingOf(known, askew()));
    expectSteps(segment.increments, known);
    expectShape(segment);
}

TEST(Compile, aRowedSlopeKeepsEveryStepOfPitchAndAPitchOnTheSpotIsInItsPlace) {
    const auto step = [](double k) {
        return Step{turnedBy(0.03 + 0.02 * std::sin(k), kPitch),
                    {0.01 * std::cos(k), 0.003 * std::sin(2 * k), 0}};
    };
    expectSteps(compileRowedSlope(recordingOf(steps(step), askew())).increments, steps(step));

    const auto drifting = [&](double k) {
        const Step still = step(k);
        return Step{still.rotation, still.translation + glm::dvec3(0.002, -0.001, 0)};
    };
    glm::dvec3 way{};
    for (const Step& each : steps(drifting)) way += each.translation;
    const Steps inPlace = steps([&](double k) {
        return Step{step(k).rotation, drifting(k).translation - way / double{kCount}};
    });
    expectSteps(compilePitch(recordingOf(steps(drifting), askew())).increments, inPlace);
}

TEST(Compile, aRowedGaitGoesStraightAndAHoverStays) {
    const auto ahead = [](double k) {
        return Step{{1, 0, 0, 0}, {0.01 + 0.005 * std::sin(k), 0, 0}};
    };
    expectSteps(compileRowed(recordingOf(steps(ahead), askew())).increments, steps(ahead));

    double way = 0;
    for (const Step& each : steps(ahead)) way += each.translation.x;
    const Steps stays = steps([&](double k) {
        return Step{{1, 0, 0, 0}, {ahead(k).translation.x - way / double{kCount}, 0, 0}};
    });
    expectSteps(compileHover(recordingOf(steps(ahead), askew())).increments, stays);
}

// A fish that leans into its bend goes round a level circle: the frame is upright, the lean is in
// the pose.
TEST(Compile, aCurveAPivotAndATurnPutTheBankIntoThePose) {
    constexpr double kBank = 0.4;
    const auto level = [](double k) {
        return Step{turnedBy(0.03 + 0.02 * std::sin(k), kYaw), {0.01, 0, 0.002 * std::cos(2 * k)}};
    };
    // The same steps in the frame of the fish, which leans.
    const glm::dquat lean = turnedBy(kBank, kRoll);
    const Steps banked = steps([&](double k) {
        return Step{glm::conjugate(lean) * level(k).rotation * lean,
                    glm::conjugate(lean) * level(k).translation};
    });
    const glm::dquat start = turnedBy(2.1, kYaw);
    const RecordedCycle recording = recordingOf(banked, start * lean, start * glm::dvec3(1, 0, 0));

    const motion::ActionSegment curve = compileCurve(recording);
    expectSteps(curve.increments, steps(level));
    expectShape(curve, kBank);
    const motion::ActionSegment turn = compileLeftTurn(recording);
    expectSteps(turn.increments, steps(level));
    expectShape(turn, kBank);

    glm::dvec3 way{};
    for (const Step& each : steps(level)) way += each.translation;
    const motion::ActionSegment pivot = compilePivot(recording);
    expectSteps(pivot.increments, steps([&](double k) {
                    return Step{level(k).rotation, level(k).translation - way / double{kCount}};
                }));
    expectShape(pivot, kBank);
}

// A turn begun with the nose off the course: the segment begins on the course, ends where the fish
// did, and after a fifth of it every step is the fish's own.
TEST(Compile, aTurnFadesInFromTheCourse) {
    constexpr double kOffCourse = 0.2;
    const Steps known = steps([](double k) {
        return Step{turnedBy(0.02 + 0.01 * std::sin(k), kYaw), {0.01, 0, 0.002}};
    });
    const glm::dquat course = turnedBy(2.1, kYaw);
    const RecordedCycle recording =
        recordingOf(known, course * turnedBy(kOffCourse, kYaw), course * glm::dvec3(1, 0, 0));
    const motion::ActionSegment turn = compileLeftTurn(recording);
    expectSteps(turn.increments, known, 13);
    glm::dquat rotation = course;
    glm::dvec3 origin = frameOf(recording.poses.front()).origin;
    for (const motion::FrameIncrement& step : turn.increments) {
        origin += rotation * glm::dvec3(step.translation);
        rotation = glm::normalize(rotation * glm::dquat(step.rotation));
    }
    const PoseFrame end = frameOf(recording.poses.back());
    EXPECT_LT(glm::distance(origin, end.origin), 1e-6);
    EXPECT_LT(glm::distance(rotation * glm::dvec3(1, 0, 0), end.worldFromBody[0]), 1e-6);
}

// The speed after a turn is that of which the law of SpeedResponse makes the measured way.
TEST(Compile, anEnteredTurnKeepsItsStepsCoursesAndSpeeds) {
    const Steps known = steps([](double k) {
        return Step{turnedBy(0.02 + 0.01 * std::sin(k), kYaw), {0.01, 0, 0.002}};
    });
    const glm::dquat start = turnedBy(-0.7, kYaw);
    glm::dquat end = start;
    for (const Step& step : known) end = end * step.rotation;
    constexpr SwimsOn kOn{.speed = 1.5, .drag = 0.4};
    constexpr double kSpeedAfter = 1.1;
    constexpr double kSeconds = 2;
    constexpr double kRate = kOn.drag * kOn.speed;
    const double way = kOn.speed * kSeconds +
                       (kSpeedAfter - kOn.speed) * (1 - std::exp(-kRate * kSeconds)) / kRate;
    const glm::dvec3 before = glm::normalize(glm::dvec3(0.9, 0, -0.1));
    const glm::dvec3 after = glm::normalize(glm::dvec3(0.8, 0, 0.2));
    const motion::TurnPath path = compileEntered({.turn = recordingOf(known, start, start * before),
                                                  .speedBefore = 1.4,
                                                  .wayAfter = way * (end * after),
                                                  .secondsAfter = kSeconds},
                                                 kOn);
    expectSteps(path.increments, known);
    EXPECT_LT(glm::distance(glm::dvec3(path.courseBefore), before), 2e-7);
    EXPECT_LT(glm::distance(glm::dvec3(path.courseAfter), after), 2e-7);
    EXPECT_EQ(path.speedBefore, 1.4F);
    EXPECT_NEAR(path.speedAfter, kSpeedAfter, 1e-6);
}

}  // namespace
}  // namespace aquarama::capture
