// SPDX-License-Identifier: Apache-2.0
#include "master/fish/secondary_controller.h"

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "common/base/units.h"
#include "common/place/place.h"

namespace aquarama::fish {
namespace {

// The bigeye scad's gaits in round numbers.
Gaits scadGaits() {
    using motion::Action;
    Gaits gaits;
    const std::array<std::int16_t, 3> rates{2185, 3277, 5461};
    const std::array speeds{1.0F, 2.0F, 2.6F};
    for (std::size_t a = 0; a < motion::kSwimmingActions; ++a) {
        gaits.phaseRate[a] = rates[a % 3];
        gaits.speed[a] = speeds[a % 3];
    }
    for (const Action gait : {Action::ForwardSlow, Action::ForwardMedium, Action::ForwardFast}) {
        const float tight = static_cast<float>(1 + indexOf(gait)) * 0.15F;  // radians a second
        gaits.yawRate[indexOf(atGait(Action::CurveLeftWideSlow, gait))] = tight / 2;
        gaits.yawRate[indexOf(atGait(Action::CurveLeftTightSlow, gait))] = tight;
        gaits.yawRate[indexOf(atGait(Action::CurveRightWideSlow, gait))] = -tight / 2;
        gaits.yawRate[indexOf(atGait(Action::CurveRightTightSlow, gait))] = -tight;
    }
    const auto add = [&](Action action, std::int16_t rate, float speed, float turn) {
        gaits.phaseRate[indexOf(action)] = rate;
        gaits.speed[indexOf(action)] = speed;
        const std::size_t first = firstSegmentOf(action);
        const std::size_t segments = isTurn(action) ? motion::kTurnSegments : 1;
        std::fill_n(gaits.turn.begin() + static_cast<std::ptrdiff_t>(first), segments, turn);
    };
    add(Action::Retreat, 2185, -0.4F, 0);
    add(Action::TurnLeftGradual, 1500, 1.7F, 0.52F);
    add(Action::TurnLeftSharp, 993, 1.5F, 0.96F);
    add(Action::TurnRightGradual, 1500, 1.7F, -0.52F);
    add(Action::TurnRightSharp, 993, 1.5F, -0.96F);
    add(Action::StartLeftSmall, 9800, 0, 0.5F);
    add(Action::StartLeftMiddle, 8700, 0, 0.85F);
    add(Action::StartLeftLarge, 7800, 0, 1.2F);
    add(Action::StartRightSmall, 9800, 0, -0.5F);
    add(Action::StartRightMiddle, 8700, 0, -0.85F);
    add(Action::StartRightLarge, 7800, 0, -1.2F);
    add(Action::Glide, 3277, 2.0F, 0);
    return gaits;
}

// One fish that heads along +x and whose intention the test sets.
struct Mind {
    Mind() {
        view.resize(1);
        states.resize(1);
        commands.resize(1);
        courses.resize(1);
        memory.resize(1);
        view.fish[0].heading.x = 1;
        startCommands(gaits, 1, 0, commands.action.size(), commands, memory);
        want(0, 2.0F);
    }
    void want(float degreesToTheLeft, float speed, float urgency = 0) {
        const float angle = degreesToTheLeft * kRadiansPerDegree<float>;
        courses[0].direction = {std::cos(angle), 0, -std::sin(angle)};
        courses[0].speed = speed;
        courses[0].urgency = urgency;
        courses[0].openToChange = true;
        motion::setSpeedBodyLengths(states, 0, speed);  // as the motor has it soon
    }
    // As one that is startled, of the highest urgency.
    void flee(float degreesToTheLeft) {
        want(degreesToTheLeft, 2.6F, 2);
        courses[0].startsFast = true;
    }
    // Thinks between two of its thoughts, as alarmed fish do.
    motion::Action thinkBetween() {
        thought[0] = 1;
        const Tick now{tick + kTicksOfAlarm};
        SecondaryController{&gaits, &view, &courses, &states, &thought, 1, now, &commands, &memory}
            .run(0, 1);
        return static_cast<motion::Action>(commands.action[0]);
    }
    // Thinks once; the motor is taken to follow at once, and to be done with every turn by then.
    motion::Action think() {
        thought[0] = thinksAt({tick}, 0) ? 1 : 0;
        SecondaryController{
            &gaits, &view, &courses, &states, &thought, 1, {tick}, &commands, &memory}
            .run(0, 1);
        tick += kTicksBetweenThoughts;
        states.segment[0] = firstSegmentOf(static_cast<motion::Action>(commands.action[0]));
        states.phase[0] = 65535;
        return static_cast<motion::Action>(commands.action[0]);
    }
    // Gives its species captured ways to stay in its place.
    void letItRow() {
        using motion::Action;
        gaits.yawRate[indexOf(Action::PivotLeft)] = 0.7F;
        gaits.yawRate[indexOf(Action::PivotRight)] = -0.7F;
        for (const Action action : {Action::Hover,
                                    Action::PivotLeft,
                                    Action::PivotRight,
                                    Action::PitchUp,
                                    Action::PitchDown})
            gaits.phaseRate[indexOf(action)] = 2731, gaits.rows[indexOf(action)] = true;
    }
    motion::Action thinkFor(int thoughts) {
        for (int i = 1; i < thoughts; ++i) think();
        return think();
    }

    Gaits gaits = scadGaits();
    FishView view;
    motion::MotionStates states;
    motion::MotorCommands commands;
    Courses courses;
    std::vector<std::uint8_t> thought{0};
    ControllerMemory memory;
    std::uint64_t tick = 0;
};

TEST(SecondaryController, aWantedSpeedBecomesSlowMediumOrFast) {
    for (const auto& [speed, gait] : {std::pair{0.9F, motion::Action::ForwardSlow},
                                      std::pair{2.0F, motion::Action::ForwardMedium},
                                      std::pair{2.8F, motion::Action::ForwardFast}}) {
        Mind mind;
        mind.want(0, speed);
        EXPECT_EQ(mind.thinkFor(8), gait) << speed;
    }
}

TEST(SecondaryController, aGaitIsPlayedFasterOrSlowerButByFifteenPercentAtMost) {
    for (float speed = 0.6F; speed < 3.2F; speed += 0.05F) {
        Mind mind;
        mind.want(0, speed);
        const auto action = static_cast<std::size_t>(mind.thinkFor(8));
        const double rate = mind.commands.phaseRate[0] * 1.0 / mind.gaits.phaseRate[action];
        EXPECT_GE(rate, 0.849);
        EXPECT_LE(rate, 1.151);
    }
    Mind mind;
    const float stretch = tempoOf(1, 0) + 0.05F;
    mind.want(0, 2.0F * stretch);
    mind.thinkFor(8);
    EXPECT_NEAR(mind.commands.phaseRate[0], stretch * 3277, 3277 * 0.75 / 32) << "to a level";
}

TEST(SecondaryController, aWantedCourseBecomesAGradualOrASharpTurnToItsSide) {
    for (const auto& [degrees, action] : {std::pair{40.0F, motion::Action::TurnLeftGradual},
                                          std::pair{-40.0F, motion::Action::TurnRightGradual},
                                          std::pair{110.0F, motion::Action::TurnLeftSharp},
                                          std::pair{-110.0F, motion::Action::TurnRightSharp}}) {
        Mind mind;
        mind.want(degrees, 2.0F);
        EXPECT_EQ(mind.think(), action) << degrees;
    }
}

TEST(SecondaryController, aSmallErrorOfCourseIsSwumOffOnACurveToItsSide) {
    using motion::Action;
    for (const auto& [degrees, curve] : {std::pair{2.0F, Action::ForwardMedium},
                                         std::pair{5.0F, Action::CurveLeftWideMedium},
                                         std::pair{12.0F, Action::CurveLeftTightMedium},
                                         std::pair{-5.0F, Action::CurveRightWideMedium},
                                         std::pair{-12.0F, Action::CurveRightTightMedium}}) {
        Mind mind;
        mind.want(degrees, 2.0F);
        EXPECT_EQ(mind.think(), curve) << degrees;
    }
}

// In each thought, whatever the fish plays: two fifths of the tight curve's rate, and none where
// the curves turn enough. With a tenth a scattered school does not form again (the scene `school`).
TEST(SecondaryController, yawIsAddedOnlyWhereTheCurvesAreNotEnough) {
    constexpr double kUnit = 60.0 / (1 << 20);  // radians a second
    bool adds = false;
    for (float degrees = -29; degrees < 30; degrees += 0.5F) {
        Mind mind;
        mind.want(degrees, 2.0F);
        const auto tight = atGait(motion::Action::CurveLeftTightSlow, gaitOf(mind.thinkFor(3)));
        const double added = std::abs(mind.commands.yawRate[0] * kUnit);
        const auto most = static_cast<double>(mind.gaits.yawRate[indexOf(tight)]);
        EXPECT_LE(added, 0.4 * most + kUnit);
        const double wanted = 1.6 * std::abs(static_cast<double>(degrees)) * 3.14159 / 180;
        if (wanted < 1.5 * most) {
            EXPECT_EQ(added, 0) << degrees;
        }
        adds |= added > 0;
    }
    EXPECT_TRUE(adds);
}

TEST(SecondaryController, aClimbOrDiveIsPlayedUntilThePitchIsNearTheWantedOne) {
    using motion::Action;
    Mind mind;
    mind.courses[0].direction = {std::sqrt(1 - 0.09F), 0.3F, 0};
    EXPECT_EQ(mind.think(), Action::ClimbMedium);
    mind.view.fish[0].heading = {std::sqrt(1 - 0.04F), 0.2F, 0};
    EXPECT_EQ(mind.think(), Action::ClimbMedium) << "it goes on";
    mind.view.fish[0].heading = {std::sqrt(1 - 0.0784F), 0.28F, 0};
    EXPECT_EQ(mind.think(), Action::ForwardMedium);
    mind.courses[0].direction = {1, 0, 0};
    EXPECT_EQ(mind.think(), Action::DiveMedium);
}

TEST(SecondaryController, aNegativeSpeedAsksForARetreat) {
    Mind mind;
    mind.letItRow();
    mind.want(20, -0.5F);
    EXPECT_EQ(mind.think(), motion::Action::Retreat);
    Mind shark;
    shark.want(20, -0.5F);
    EXPECT_EQ(shark.think(), motion::Action::Glide) << "it cannot row";
}

// A mind that wavers by less than a level does not change its command.
TEST(SecondaryController, aCommandStandsUntilTheCourseDiffersByALevel) {
    Mind mind;
    mind.want(1, 2.0F);
    mind.courses[0].openToChange = false;
    mind.thinkFor(8);
    const motion::MotorCommands before = mind.commands;
    for (int i = 0; i < 20; ++i) {
        mind.want(i % 2 == 0 ? 1.2F : 0.8F, i % 2 == 0 ? 1.99F : 2.01F);
        mind.courses[0].openToChange = false;
        mind.think();
        EXPECT_EQ(mind.commands.action, before.action);
        EXPECT_EQ(mind.commands.phaseRate, before.phaseRate);
        EXPECT_EQ(mind.commands.yawRate, before.yawRate);
        EXPECT_EQ(mind.commands.pitch, before.pitch);
    }
}

TEST(SecondaryController, inDangerItTurnsSharplyEarlier) {
    Mind calm;
    calm.want(48, 2.0F);
    EXPECT_EQ(calm.think(), motion::Action::TurnLeftGradual);
    Mind alarmed;
    alarmed.want(48, 2.0F, 1.5F);
    EXPECT_EQ(alarmed.think(), motion::Action::TurnLeftSharp);
}

TEST(SecondaryController, backwardsItKeepsTheSideOfTheTurnItIsIn) {
    Mind mind;
    mind.want(170, 2.0F);
    EXPECT_EQ(mind.think(), motion::Action::TurnLeftSharp);
    mind.states.segment[0] = firstSegmentOf(motion::Action::TurnLeftGradual);
    mind.want(-175, 2.0F);
    EXPECT_EQ(mind.think(), motion::Action::TurnLeftSharp);
}

TEST(SecondaryController, inDangerItDoesNotBreakATurnOff) {
    for (const float urgency : {0.0F, 0.5F, 1.5F}) {
        Mind mind;
        mind.want(100, 2.0F, urgency);
        ASSERT_EQ(mind.think(), motion::Action::TurnLeftSharp);
        mind.want(-100, 2.0F, urgency);
        mind.states.phase[0] = 20000;
        EXPECT_EQ(mind.think(),
                  urgency == 0 ? motion::Action::TurnRightSharp : motion::Action::TurnLeftSharp);
        mind.states.segment[0] = firstSegmentOf(motion::Action::TurnLeftSharp);
        mind.states.phase[0] = 65000;
        EXPECT_EQ(mind.think(), motion::Action::TurnRightSharp) << "at its end it may";
    }
}

TEST(SecondaryController, aStartledFishMakesTheFastStartWhoseTurnIsNearest) {
    for (const auto& [degrees, start] : {std::pair{30.0F, motion::Action::StartLeftSmall},
                                         std::pair{48.0F, motion::Action::StartLeftMiddle},
                                         std::pair{90.0F, motion::Action::StartLeftLarge},
                                         std::pair{-90.0F, motion::Action::StartRightLarge}}) {
        Mind mind;
        mind.flee(degrees);
        EXPECT_EQ(mind.think(), start) << degrees;
    }
    Mind ahead;
    ahead.flee(10);
    EXPECT_FALSE(isStart(ahead.think())) << "straight on is nearer";
}

TEST(SecondaryController, aFastStartIsMadeAgainOnlyAfterASecondAndAHalf) {
    Mind mind;
    mind.flee(90);
    ASSERT_TRUE(isStart(mind.think()));
    for (std::uint64_t ticks = kTicksBetweenThoughts; ticks < 90; ticks += kTicksBetweenThoughts) {
        mind.flee(90);
        EXPECT_FALSE(isStart(mind.think())) << ticks;
    }
    mind.flee(90);
    EXPECT_TRUE(isStart(mind.think()));
}

// In danger a turn stands against another one, but not against a fast start. What the turn would
// still have done does not count.
TEST(SecondaryController, aFastStartBreaksOffATurnInDanger) {
    Mind mind;
    mind.want(80, 2.6F, 2);
    ASSERT_EQ(mind.think(), motion::Action::TurnLeftSharp);
    mind.states.phase[0] = 20000;
    mind.flee(-30);
    EXPECT_EQ(mind.think(), motion::Action::StartRightSmall);
}

TEST(SecondaryController, betweenItsThoughtsAnAlarmedFishOnlyMakesAFastStart) {
    Mind mind;
    const motion::Action before = mind.think();
    mind.want(90, 2.6F, 2);
    EXPECT_EQ(mind.thinkBetween(), before);
    mind.flee(90);
    EXPECT_EQ(mind.thinkBetween(), motion::Action::StartLeftLarge);
}

TEST(SecondaryController, whatATurnWillHaveDoneCounts) {
    for (const float degrees : {90.0F, 40.0F}) {
        Mind mind;
        mind.want(degrees, 2.0F);
        const motion::Action turn = mind.think();
        EXPECT_TRUE(isTurn(turn) && isLeft(turn));
        mind.states.phase[0] = 0;  // just begun: all of its 55 or 30 degrees are still to come
        mind.want(degrees > 50 ? 57 : 30, 2.0F);
        EXPECT_TRUE(isForward(mind.think())) << "one turn is enough";
    }
}

TEST(SecondaryController, whatFollowsATurnIsChosenInItsLastTick) {
    Mind mind;
    mind.want(90, 2.0F);
    mind.think();
    EXPECT_GT(mind.commands.phaseRate[0], 0.85 * 993);
    mind.states.phase[0] = 60000;
    mind.want(0, 2.0F);
    ++mind.tick;  // not its time to think
    EXPECT_EQ(mind.think(), motion::Action::TurnLeftSharp);
    mind.states.phase[0] = 65000;
    EXPECT_TRUE(isForward(mind.think()));
}

TEST(SecondaryController, aFishThatIsMuchTooFastBrakes) {
    Mind mind;
    mind.want(0, 1.0F);
    for (const auto& [speed, brake] : {std::pair{1.5F, 0}, {2.1F, 127}, {4.0F, 255}}) {
        motion::setSpeedBodyLengths(mind.states, 0, speed);
        mind.thinkFor(8);
        EXPECT_NEAR(mind.commands.brake[0], brake, 1) << speed;
    }
}

TEST(SecondaryController, aGlideIsRecommendedToThoseWhoAreFastEnough) {
    for (const float speed : {1.4F, 1.8F}) {
        Mind mind;
        bool glides = false;
        for (int i = 0; i < 5 * 60 * 60 / 8; ++i) {
            mind.want(0, 1.6F);
            motion::setSpeedBodyLengths(mind.states, 0, speed);
            glides |= mind.think() == motion::Action::Glide;
        }
        EXPECT_EQ(glides, speed > 1.6F);
    }
}

TEST(SecondaryController, aSpeedAboutABorderDoesNotDither) {
    Mind mind;
    int switches = 0;
    motion::Action last = mind.think();
    for (int i = 0; i < 25; ++i) {  // less than the shortest patience
        mind.want(0, i % 2 == 0 ? 1.45F : 1.55F);
        const motion::Action next = mind.think();
        switches += next == last ? 0 : 1;
        last = next;
    }
    EXPECT_LE(switches, 1);
}

TEST(SecondaryController, oneWhoSwamOnePatternForLongChangesItForAWhile) {
    Mind mind;
    std::set<motion::Action> seen;
    int elsewhere = 0;
    for (int i = 0; i < 2 * 60 * 60 / 8; ++i) {  // two minutes
        mind.want(0, 1.6F);
        const motion::Action action = mind.think();
        seen.insert(action);
        elsewhere += action == motion::Action::ForwardMedium ? 0 : 1;
    }
    EXPECT_GE(seen.size(), 3U);
    EXPECT_GT(elsewhere, 20);
}

TEST(SecondaryController, theIntentionMayRefuseARecommendation) {
    Mind mind;
    for (int i = 0; i < 2 * 60 * 60 / 8; ++i) {
        mind.want(0, 2.0F);
        mind.courses[0].openToChange = false;
        EXPECT_EQ(mind.think(), motion::Action::ForwardMedium);
    }
}

TEST(SecondaryController, theIntentionMayWithdrawItsConsent) {
    Mind mind;
    int withdrawn = 0;
    for (int i = 0; i < 2 * 60 * 60 / 8; ++i) {
        mind.want(0, 2.0F);
        const motion::Action action = mind.think();
        if (!isForward(action) || action == motion::Action::ForwardMedium) continue;
        mind.courses[0].openToChange = false;
        EXPECT_EQ(mind.thinkFor(6), motion::Action::ForwardMedium)
            << "after the shortest time of a gait";
        ++withdrawn;
    }
    EXPECT_GT(withdrawn, 0);
}

TEST(SecondaryController, aFishThatRowsHoversPivotsAndPitchesInItsPlace) {
    using motion::Action;
    Mind mind;
    mind.letItRow();
    mind.want(2, 0.1F);
    EXPECT_EQ(mind.think(), Action::Hover);
    mind.want(50, 0.1F);
    EXPECT_EQ(mind.think(), Action::PivotLeft);
    EXPECT_EQ(mind.commands.yawRate[0], 0) << "nothing is added to what was captured";
    mind.want(-12, 0.1F);
    EXPECT_EQ(mind.think(), Action::PivotRight);
    mind.want(-5, 0.1F);
    EXPECT_EQ(mind.think(), Action::Hover) << "it turns on until the next thought";
    mind.want(0, 0.1F);
    mind.courses[0].direction = {std::sqrt(1 - 0.04F), -0.2F, 0};
    EXPECT_EQ(mind.think(), Action::PitchDown);
}

TEST(SecondaryController, aFishThatWantsToBeWhereItIsGlidesAndBrakes) {
    Mind mind;
    mind.want(50, 0.1F);
    motion::setSpeedBodyLengths(mind.states, 0, 1.0F);
    EXPECT_EQ(mind.think(), motion::Action::Glide);
    EXPECT_EQ(mind.commands.brake[0], 255);
    EXPECT_GT(mind.commands.yawRate[0], 0) << "it turns about its fins";
    motion::setSpeedBodyLengths(mind.states, 0, 0.05F);
    EXPECT_EQ(mind.think(), motion::Action::Glide);
    EXPECT_EQ(mind.commands.brake[0], 0);
}

TEST(SecondaryController, oneThatHoversTurnsAwayFromDanger) {
    Mind mind;
    mind.want(50, 0.0F, 1.5F);
    EXPECT_EQ(mind.think(), motion::Action::TurnLeftSharp);
}

TEST(SecondaryController, temposDifferByTenPercentAtMost) {
    float slowest = 9, fastest = 0;
    for (std::size_t fish = 0; fish < 200; ++fish) {
        slowest = std::min(slowest, tempoOf(1, fish));
        fastest = std::max(fastest, tempoOf(1, fish));
    }
    EXPECT_GE(slowest, 0.9F);
    EXPECT_LE(fastest, 1.1F);
    EXPECT_GT(fastest - slowest, 0.15F);
}

}  // namespace
}  // namespace aquarama::fish
