// SPDX-License-Identifier: Apache-2.0
// The patterns beside swimming and turning (paper, section 3.2): retreat, brake, glide, ascend and
// descend.
#include "common/motion/gaze.h"
#include "common/motion/motor_tables.h"
#include "tests/common/motion/captured_species.h"
#include "tests/common/motion/school.h"

namespace aquarama::motion {
namespace {

constexpr std::array<Action, 3> kForward{
    Action::ForwardSlow, Action::ForwardMedium, Action::ForwardFast};
constexpr SpeedResponse kAtOnce{};
constexpr SpeedResponse kResponse{
    .swimDrag = {0.6F, 0.5F, 0.4F}, .retreatDrag = 4.0F, .glideDrag = 0.4F, .brakeRate = 2.0F};

double speedOf(const School& school) {
    return static_cast<double>(speedBodyLengths(school.states, 0));
}

// Body lengths along the x axis.
double wayOf(const School& school) {
    return school.place(0).x / (school.traits[0].lengthMillimetres * 1e-3);
}

class Patterns : public OfEachSpecies {};

TEST_P(Patterns, aRetreatingFishSwimsAgainstItsHeading) {
    const auto tables = tablesOf(GetParam(), kResponse);
    School school(1, *tables);
    school.play(0, Action::ForwardMedium);
    school.command(0, Action::Retreat);
    school.tick(1800);
    const glm::dvec3 from = school.place(0);
    school.tick(600);
    const glm::dvec3 velocity = (school.place(0) - from) / (10 * 0.2);
    const glm::dvec3 ahead = school.mean(0) * glm::dvec3(1, 0, 0);
    const auto recorded = static_cast<double>(recordedSpeedBodyLengths(*tables, Action::Retreat));
    if (recorded == 0) return;  // a shark does not row
    EXPECT_LT(recorded, 0);
    EXPECT_NEAR(glm::dot(velocity, ahead), recorded, -0.02 * recorded);
    EXPECT_NEAR(speedOf(school), recorded, -0.02 * recorded);
}

// 1 / v = 1 / v0 + k t, and the way is ln(1 + v0 k t) / k.
TEST_P(Patterns, aGlidingFishLosesItsSpeedToTheSquareOfItAlone) {
    const auto tables = tablesOf(GetParam(), kResponse);
    School school(1, *tables);
    school.play(0, Action::Glide);
    school.commands.phaseRate[0] = 0;
    const double v0 = 2.0;
    const double k = static_cast<double>(kResponse.glideDrag);
    setSpeedBodyLengths(school.states, 0, static_cast<float>(v0));
    for (int tick = 1; tick <= 600; ++tick) {
        school.tick();
        const double seconds = tick / 60.0;
        ASSERT_NEAR(speedOf(school), 1 / (1 / v0 + k * seconds), 0.01) << seconds << " s";
        const double way = std::log(1 + v0 * k * seconds) / k;
        ASSERT_NEAR(wayOf(school), way, 0.01 * way + 0.01) << seconds << " s";
    }
}

TEST_P(Patterns, aGlideIsEnteredByAWarpAndKeepsTheSpeedThatTheFishHad) {
    const auto tables = tablesOf(GetParam(), kResponse);
    School school(1, *tables);
    school.play(0, Action::ForwardFast);
    school.tick(30);
    const double before = speedOf(school);
    school.command(0, Action::Glide);
    school.tick(school.states.warpLength[0] + 1);
    EXPECT_EQ(school.states.segment[0], firstSegmentOf(Action::Glide));
    EXPECT_GT(speedOf(school), 0.9 * before);
    EXPECT_LT(speedOf(school), before);
}

// Under dv/dt = -k v^2 - r v a fish comes to rest within ln(1 + k v0 / r) / k.
TEST_P(Patterns, aBrakingFishSlowsDownAtEveryTickUntilItStopsWithinTheStatedWay) {
    const auto tables = tablesOf(GetParam(), kResponse);
    for (const Action action : kForward) {
        School school(1, *tables);
        school.play(0, action);
        school.tick(20);
        school.command(0, Action::Glide);
        school.commands.brake[0] = 255;
        const double v0 = speedOf(school);
        const auto k = static_cast<double>(kResponse.glideDrag);
        const auto r = static_cast<double>(kResponse.brakeRate);
        const double from = wayOf(school);
        int ticks = 0;
        for (double last = v0; last > 0; ++ticks) {
            school.tick();
            ASSERT_LT(speedOf(school), last);
            last = speedOf(school);
        }
        EXPECT_LT(ticks, 8 * 60);
        const double way = std::log(1 + k * v0 / r) / k;
        EXPECT_NEAR(wayOf(school) - from, way, 0.02 * way + 0.002);
        school.tick(60);
        EXPECT_EQ(speedOf(school), 0) << "and stays";
    }
}

// What is seen of it: the fins open and close within a fifth of a second, and by even steps.
TEST_P(Patterns, finsFollowTheCommandedBrakeWithinAFifthOfASecond) {
    const auto tables = tablesOf(GetParam(), kResponse);
    School school(1, *tables);
    school.play(0, Action::ForwardMedium);
    for (const int brake : {255, 0, 100}) {
        const int from = school.states.spread[0];
        school.commands.brake[0] = static_cast<std::uint8_t>(brake);
        school.tick(6);
        const int way = std::min(std::abs(brake - from), 6 * kSpreadStep);
        EXPECT_EQ(school.states.spread[0], from + (brake > from ? way : -way));
        school.tick(7);
        EXPECT_EQ(school.states.spread[0], brake);
    }
}

// Mouth and eyes likewise, and they move nothing else.
TEST_P(Patterns, mouthAndEyesFollowTheirCommands) {
    const auto tables = tablesOf(GetParam(), kResponse);
    School school(2, *tables);
    for (const std::size_t fish : {0U, 1U}) school.play(fish, Action::ForwardMedium);
    school.commands.mouth[0] = 255;
    school.commands.gaze[0] = gazeTowards({-1, 0, 0});
    school.tick(3);
    EXPECT_EQ(school.states.mouth[0], 3 * kMouthStep);
    EXPECT_EQ(school.states.gaze[0] & 15U, 13U) << "three steps to the left";
    school.tick(5);
    EXPECT_EQ(school.states.mouth[0], 255);
    EXPECT_EQ(school.states.gaze[0], gazeTowards({-1, 0, 0}));
    EXPECT_EQ(school.states.mouth[1], 0);
    EXPECT_EQ(school.states.speed[0], school.states.speed[1]);
    EXPECT_EQ(school.states.phase[0], school.states.phase[1]);
}

// At half the speed s of the segment, dv/dt = swimDrag s^2 / 2.
TEST_P(Patterns, aFishAtHalfTheSpeedOfItsGaitGathersSpeedByTheDragOfThatGait) {
    const auto tables = tablesOf(GetParam(), kResponse);
    for (const Action action : kForward) {
        School school(1, *tables);
        school.play(0, action);
        const auto recorded = static_cast<double>(recordedSpeedBodyLengths(*tables, action));
        setSpeedBodyLengths(school.states, 0, static_cast<float>(recorded / 2));
        school.tick();
        const auto drag = static_cast<double>(kResponse.swimDrag[static_cast<std::size_t>(action)]);
        const double gained = speedOf(school) - recorded / 2;
        EXPECT_NEAR(gained * 60, drag * recorded * recorded / 2, 0.01) << nameOf(action);
    }
}

TEST_P(Patterns, halfSpreadFinsBrakeLessThanWhollySpreadOnes) {
    const auto tables = tablesOf(GetParam(), kResponse);
    double last = 9;
    for (const int brake : {0, 60, 128, 255}) {
        School school(1, *tables);
        school.play(0, Action::ForwardMedium);
        school.commands.brake[0] = static_cast<std::uint8_t>(brake);
        school.tick(20);
        EXPECT_LT(speedOf(school), last) << brake;
        EXPECT_GT(speedOf(school), 0);
        last = speedOf(school);
    }
}

TEST_P(Patterns, anAscendingOrDescendingFishHoldsTheCommandedPitch) {
    for (const Action action : kForward) {
        for (const double pitch : {-45.0, -20.0, 20.0, 45.0}) {
            School school(1, tablesOf(GetParam()));
            school.play(0, action);
            school.commands.pitch[0] =
                static_cast<std::int16_t>(std::lround(std::sin(pitch * kDegree) * 32768));
            const auto rate =
                static_cast<double>(school.tables->pitchRate[indexOf(action)]);  // radians a tick
            school.tick(180 + static_cast<int>(std::abs(pitch) * kDegree / rate));
            const glm::dvec3 from = school.place(0);
            for (int tick = 0; tick < 300; ++tick) {
                school.tick();
                ASSERT_NEAR(school.pitch(0), pitch, 0.5) << nameOf(action);
            }
            const glm::dvec3 way = school.place(0) - from;
            EXPECT_NEAR(std::asin(way.y / glm::length(way)) / kDegree, pitch, 1) << nameOf(action);
        }
    }
}

TEST_P(Patterns, aTurnEnteredFastGoesFurtherThanOneEnteredSlowlyAndEndsFaster) {
    const auto tables = tablesOf(GetParam(), kResponse);
    double lastWay = 0;
    double lastSpeed = 0;
    for (const double share : {0.5, 1.0, 1.5}) {
        School school(1, *tables);
        school.play(0, Action::TurnLeftSharp);
        const auto medium =
            static_cast<double>(recordedSpeedBodyLengths(*tables, Action::ForwardMedium));
        setSpeedBodyLengths(school.states, 0, static_cast<float>(share * medium));
        school.tick(65535 / school.commands.phaseRate[0]);
        EXPECT_GT(glm::length(school.place(0)), 1.05 * lastWay);
        EXPECT_GT(speedOf(school), lastSpeed);
        lastWay = glm::length(school.place(0));
        lastSpeed = speedOf(school);
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         Patterns,
                         testing::ValuesIn(allSpeciesNames()),
                         OfEachSpecies::suffix);

}  // namespace
}  // namespace aquarama::motion
