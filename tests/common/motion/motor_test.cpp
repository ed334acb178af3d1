// SPDX-License-Identifier: Apache-2.0
#include "common/motion/motor.h"

#include <gtest/gtest.h>

#include "common/motion/motor_tables.h"
#include "common/motion/reconstruct.h"
#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

constexpr std::array<Action, 3> kForward{
    Action::ForwardSlow, Action::ForwardMedium, Action::ForwardFast};

TEST(MotorTables, knowTheRatesThatWereRecorded) {
    EXPECT_EQ(recordedPhaseRate(sharedTables(), Action::ForwardSlow), 1092);  // 65536 / 60
    EXPECT_EQ(recordedPhaseRate(sharedTables(), Action::ForwardFast), 3277);
    const auto gaits = synthetic::gaits();
    for (int a = 0; a < kCapturedActions; ++a) {
        const auto action = static_cast<Action>(a);
        const synthetic::Gait& gait = gaits[static_cast<std::size_t>(a)];
        EXPECT_NEAR(recordedSpeedBodyLengths(sharedTables(), action),
                    gait.stride / gait.periodSeconds,
                    gait.bends ? 0.08 : 0.01)  // in a C-bend the origin leaves the course
            << nameOf(action);
        EXPECT_NEAR(recordedTurnRate(sharedTables(), firstSegmentOf(action)),
                    gait.turnRadians / gait.periodSeconds,
                    0.01)
            << nameOf(action);
    }
}

// 100 cycles at three speeds, at the recorded rate and at rates that never meet a sample.
TEST(Motor, aStraightSwimmerNeitherLeavesItsCourseNorRolls) {
    constexpr std::array<int, 4> kRates{0, 1001, 2999, 7919};
    for (const Action action : kForward) {
        for (const int rate : kRates) {
            for (const int length : {40, 200, 4000}) {
                School school(1);
                school.traits[0].lengthMillimetres = static_cast<std::uint16_t>(length);
                school.play(0, action);
                if (rate != 0) school.playAtRate(0, action, rate);
                const double heading = school.heading(0);
                const int ticks = 100 * 65536 / school.commands.phaseRate[0];
                for (int i = 0; i < ticks; ++i) {
                    school.tick();
                    ASSERT_LT(std::abs(school.roll(0)), 0.1);
                    ASSERT_LT(std::abs(school.pitch(0)), 0.1);
                    ASSERT_LT(std::abs(school.heading(0) - heading), 0.2);
                }
                const glm::dvec3 way = school.place(0);
                const double course = std::atan2(-way.z, way.x) / kDegree;
                EXPECT_NEAR(course, heading, 0.3) << nameOf(action) << ' ' << rate;
                EXPECT_NEAR(std::atan2(way.y, way.x) / kDegree, 0, 0.2);
            }
        }
    }
}

TEST(Motor, aCycleCoversTheRecordedStrideAtAnyRate) {
    for (const Action action : kForward) {
        for (const int ticksACycle : {7, 16, 64, 333}) {
            School school(1);
            school.playAtRate(0, action, 65536 / ticksACycle);
            int played = 0;
            while (played < 10 * 65536) {
                school.tick();
                played += school.commands.phaseRate[0];
            }
            const double cycles = played / 65536.0;
            EXPECT_NEAR(glm::length(school.place(0)) / 0.2,
                        cycles * synthetic::kStrideBodyLengths,
                        0.01 * cycles);
        }
    }
}

TEST(Motor, aFishOfTwiceTheLengthSwimsTwiceTheMetres) {
    School school(2);
    for (const std::size_t fish : {0U, 1U}) school.play(fish, Action::ForwardMedium);
    school.traits[1].lengthMillimetres = 400;
    school.tick(600);
    const double ratio = glm::length(school.place(1)) / glm::length(school.place(0));
    EXPECT_NEAR(ratio, 2.0, 0.002);
}

TEST(Motor, aTurnThatGoesOnIsEnteredAnewAndStaysLevel) {
    for (const Action action : {Action::TurnLeftGradual, Action::TurnRightGradual}) {
        School school(1);
        school.play(0, action);
        double turned = 0;
        double last = school.heading(0);
        int entries = 0;
        while (entries < 12) {
            const std::uint16_t phase = school.states.phase[0];
            school.tick();
            entries += school.states.phase[0] < phase ? 1 : 0;
            turned += std::remainder(school.heading(0) - last, 360);
            last = school.heading(0);
            ASSERT_LT(std::abs(school.roll(0)), 0.5);
            ASSERT_LT(std::abs(school.pitch(0)), 0.5);
        }
        EXPECT_NEAR(turned, (action == Action::TurnLeftGradual ? 1 : -1) * 12 * 30, 4);
    }
}

TEST(Motor, aSharpTurnPlaysToItsEndAndTurnsAsRecorded) {
    School school(1);
    school.play(0, Action::ForwardMedium);
    school.tick(40);
    const double heading = school.heading(0);
    school.command(0, Action::TurnLeftSharp);
    school.tick(10);
    EXPECT_EQ(actionOf(school.states.segment[0]), Action::TurnLeftSharp);
    school.command(0, Action::ForwardMedium);  // asked too early: it waits for the end
    school.tick(30);
    EXPECT_EQ(actionOf(school.states.segment[0]), Action::TurnLeftSharp);
    school.tick(60);
    EXPECT_EQ(school.states.segment[0], indexOf(Action::ForwardMedium));
    EXPECT_NEAR(std::remainder(school.heading(0) - heading, 360), 60, 1.5);
    EXPECT_LT(std::abs(school.roll(0)), 0.5);
}

// As in a fast start, where the body recoils. The fish would gather speed by its drag alone, which
// is next to nothing here.
TEST(Motor, aFishSlowerThanItsPathGoesOnAfterThePathWentBack) {
    Repertoire repertoire = sharedRepertoire();
    repertoire.response.swimDrag = {1e-3F, 1e-3F, 1e-3F};
    ActionSegment& start = repertoire.segments[indexOf(Action::StartLeftSmall)];
    start.playsToEnd = true;
    start.entered.clear();
    for (std::size_t k = 0; k < kPhases; ++k)
        start.increments[k] = {glm::quat(1, 0, 0, 0), {k / 2 == 15 ? -0.002F : 0.01F, 0, 0}};
    const auto tables = makeMotorTables(repertoire);
    School school(1, *tables);
    school.play(0, Action::StartLeftSmall);
    const float slower = 0.5F * speedBodyLengths(school.states, 0);
    setSpeedBodyLengths(school.states, 0, slower);
    bool stood = false;
    while (school.states.phase[0] < 40 * (65536 / kPhases)) {
        school.tick();
        stood = stood || speedBodyLengths(school.states, 0) < 0.01F * slower;
    }
    EXPECT_TRUE(stood);
    EXPECT_GT(speedBodyLengths(school.states, 0), 0.9F * slower);
}

TEST(Motor, changingGaitKeepsTheCourse) {
    std::mt19937 random(3);
    School school(1);
    school.play(0, Action::ForwardSlow);
    school.tick(10);
    const double heading = school.heading(0);
    for (int change = 0; change < 200; ++change) {
        school.command(0, kForward[random() % 3]);
        school.tick(static_cast<int>(10 + random() % 50));
        ASSERT_NEAR(school.heading(0), heading, 0.3);
    }
    const glm::dvec3 way = school.place(0);
    EXPECT_NEAR(std::atan2(-way.z, way.x) / kDegree, heading, 0.5);
}

TEST(Motor, aRolledFishLevelsOut) {
    for (const double degrees : {40.0, -40.0, 120.0, 180.0}) {
        School school(1);
        setBodyFrame(school.states, 0, {glm::vec3(0), aboutAxis(degrees, {1, 0, 0})});
        school.play(0, Action::ForwardMedium);
        double last = school.roll(0);
        for (int i = 0; i < 300; ++i) {
            school.tick();
            EXPECT_LT(std::abs(std::remainder(school.roll(0) - last, 360)), 46.0 / 60);
            last = school.roll(0);
        }
        EXPECT_LT(std::abs(school.roll(0)), 1.0) << degrees;
        EXPECT_LT(std::abs(school.pitch(0)), 1.0) << degrees;
    }
}

// No faster than by a part of the captured climb, which pitches by 8 degrees in half a second.
TEST(Motor, pitchIsTrimmedToTheCommandAtAPartOfTheRateOfTheClimb) {
    constexpr double kTrimDegrees = 16.0 / 60 * static_cast<double>(kAddedPitch);  // a tick
    for (const double wanted : {0.0, 20.0, -30.0, 45.0}) {
        for (const double start : {wanted, wanted - 4, wanted + 3}) {
            School school(1);
            setBodyFrame(school.states, 0, {glm::vec3(0), aboutAxis(start, {0, 0, 1})});
            school.play(0, Action::ForwardMedium);
            school.commands.pitch[0] =
                static_cast<std::int16_t>(std::lround(std::sin(wanted * kDegree) * 32767));
            double last = school.pitch(0);
            for (int i = 0; i < 1200; ++i) {
                school.tick();
                ASSERT_LT(std::abs(school.pitch(0) - last), kTrimDegrees + 1.0 / 60);
                last = school.pitch(0);
            }
            EXPECT_NEAR(school.pitch(0), wanted, 0.5);
            EXPECT_LT(std::abs(school.roll(0)), 0.5);
        }
    }
}

TEST(Motor, noCommandPitchesBeyondSixtyDegrees) {
    for (const int command : {32767, -32768}) {
        School school(1);
        school.play(0, Action::ForwardMedium);
        school.commands.pitch[0] = static_cast<std::int16_t>(command);
        for (int i = 0; i < 12000; ++i) {
            school.tick();
            ASSERT_LT(std::abs(school.pitch(0)), 60.5);
        }
        EXPECT_NEAR(std::abs(school.pitch(0)), 60, 0.5);
    }
}

TEST(Motor, aFishThatStandsOnItsTailComesDown) {
    School school(1);
    setBodyFrame(school.states, 0, {glm::vec3(0), aboutAxis(90, {0, 0, 1})});
    school.play(0, Action::ForwardMedium);
    school.tick(18000);
    EXPECT_LT(std::abs(school.pitch(0)), 1.0);
    EXPECT_LT(std::abs(school.roll(0)), 1.0);
}

TEST(Motor, yawIsAddedAboutTheWorldsUp) {
    School school(1);
    setBodyFrame(school.states, 0, {glm::vec3(0), aboutAxis(30, {0, 0, 1})});
    school.play(0, Action::ForwardMedium);
    school.commands.pitch[0] = 16384;   // 30 degrees
    school.commands.yawRate[0] = 3660;  // 12 degrees a second to the left
    const double heading = school.heading(0);
    school.tick(300);
    EXPECT_NEAR(school.heading(0) - heading, 60, 0.5);
    EXPECT_NEAR(school.pitch(0), 30, 0.5);
    EXPECT_LT(std::abs(school.roll(0)), 0.5);
}

TEST(Motor, aRestingFishStaysExactlyWhereItIs) {
    School school(1);
    school.play(0, Action::ForwardMedium);
    school.commands.phaseRate[0] = 0;
    school.tick(30000);  // to come to rest: the water's drag alone takes its time
    EXPECT_EQ(school.states.speed[0], 0);
    const FishRecord before = recordOf(school.states, 0);
    school.tick(600);
    EXPECT_EQ(recordOf(school.states, 0), before);
}

TEST(Motor, anUnknownActionIsNotPlayed) {
    School school(1);
    school.play(0, Action::ForwardMedium);
    school.commands.action[0] = kActions;
    school.tick(10);
    EXPECT_EQ(school.states.segment[0], indexOf(Action::ForwardMedium));
    EXPECT_GT(school.place(0).x, 0.01);
}

// The furthest that any nodal point moves in a tick, at recorded rates: what the eye knows already.
double largestRecordedStep() {
    double most = 0;
    for (int a = 0; a < kActions; ++a) {
        PresentedFish fish;
        fish.action = static_cast<std::uint32_t>(a);
        const int rate = recordedPhaseRate(sharedTables(), static_cast<Action>(a));
        for (int phase = 0; phase < 65536; phase += 256) {
            body::NodalPoints now;
            body::NodalPoints next;
            fish.phase = static_cast<float>(phase) / 65536.0F;
            nodalPose(sharedRepertoire(), fish, now);
            fish.phase = static_cast<float>((phase + rate) % 65536) / 65536.0F;
            nodalPose(sharedRepertoire(), fish, next);
            for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
                most = std::max(most, static_cast<double>(glm::distance(now[i], next[i])));
            }
        }
    }
    return most;
}

body::NodalPoints poseOf(const School& school) {
    const FishRecord record = recordOf(school.states, 0);
    body::NodalPoints nodes;
    nodalPose(sharedRepertoire(), present(record, record, 1.0F, school.traits[0]), nodes);
    return nodes;
}

TEST(MotionWarp, noNodalPointMovesFurtherThanTheEyeIsUsedTo) {
    const double allowed = 1.25 * largestRecordedStep();
    for (int from = 0; from < kActions; ++from) {
        for (int to = 0; to < kActions; ++to) {
            if (from == to) continue;
            for (int phase = 0; phase < 65536; phase += 1111) {
                School school(1);
                school.play(0, static_cast<Action>(from));
                school.states.phase[0] = static_cast<std::uint16_t>(phase);
                school.command(0, static_cast<Action>(to));
                body::NodalPoints last = poseOf(school);
                for (int tick = 0; tick < 90; ++tick) {
                    school.tick();
                    const body::NodalPoints now = poseOf(school);
                    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
                        ASSERT_LT(static_cast<double>(glm::distance(last[i], now[i])), allowed)
                            << nameOf(static_cast<Action>(from)) << " at " << phase << " to "
                            << nameOf(static_cast<Action>(to)) << " node " << i;
                    }
                    last = now;
                }
                ASSERT_EQ(actionOf(school.states.segment[0]), static_cast<Action>(to));
            }
        }
    }
}

TEST(MotionWarp, theFishKeepsSwimmingWhileItWarps) {
    School school(1);
    school.play(0, Action::ForwardMedium);
    school.tick(30);
    school.command(0, Action::TurnLeftSharp);
    const double mediumMetresATick = 0.2 * 2 * synthetic::kStrideBodyLengths / 60;
    int warped = 0;
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 before = school.place(0);
        school.tick();
        const double metresATick = glm::distance(school.place(0), before);
        EXPECT_GT(metresATick, 0.5 * mediumMetresATick);
        warped += school.states.warpFrame[0] != school.states.warpLength[0] ? 1 : 0;
    }
    EXPECT_GT(warped, 0);
    EXPECT_EQ(warped, school.states.warpLength[0]);
}

TEST(MotionWarp, thePhaseRunsOnWhenTheWarpHasEnded) {
    School school(1);
    school.play(0, Action::ForwardSlow);
    school.tick(7);
    school.command(0, Action::TurnRightSharp);
    school.tick();
    const int frames = school.states.warpLength[0];
    ASSERT_GT(frames, 0);
    // A turn plays during its warp.
    const int entry = (frames + 1) * recordedPhaseRate(sharedTables(), Action::TurnRightSharp);
    EXPECT_EQ(school.states.phase[0], entry);
    school.tick(frames);
    EXPECT_EQ(school.states.warpFrame[0], frames);
    EXPECT_EQ(school.states.phase[0], entry);
    school.tick();
    EXPECT_EQ(school.states.phase[0], entry + school.commands.phaseRate[0]);
}

}  // namespace
}  // namespace aquarama::motion
