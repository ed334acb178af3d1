// SPDX-License-Identifier: Apache-2.0
#include "master/fish/secondary_controller.h"

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
    return {{2185, 3277, 5461, 1500, 993, 1500, 993, 3277},
            {1.0F, 2.0F, 2.6F, 1.7F, 1.5F, 1.7F, 1.5F, 2.0F},
            {0, 0, 0, 0.52F, 0.96F, -0.52F, -0.96F, 0}};
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
        startCommands(gaits, 1, 0, commands.segment.size(), commands, memory);
        want(0, 2.0F);
    }
    void want(float degreesToTheLeft, float speed, float urgency = 0) {
        const float angle = degreesToTheLeft * kRadiansPerDegree<float>;
        courses[0].direction = {std::cos(angle), 0, -std::sin(angle)};
        courses[0].speed = speed;
        courses[0].urgency = urgency;
        courses[0].openToChange = true;
    }
    // Thinks once; the motor is taken to follow at once, and to be done with every turn by then.
    motion::Action think() {
        SecondaryController{&gaits, &view, &courses, &states, 1, {tick}, &commands, &memory}.run(0,
                                                                                                 1);
        tick += kTicksBetweenThoughts;
        states.segment[0] = commands.segment[0];
        states.phase[0] = 65535;
        return static_cast<motion::Action>(commands.segment[0]);
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
    EXPECT_NEAR(mind.commands.phaseRate[0], stretch * 3277, 2);
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

TEST(SecondaryController, aSmallErrorOfCourseIsSteeredWithinTheStroke) {
    Mind mind;
    mind.want(10, 2.0F);
    EXPECT_TRUE(isForward(mind.think()));
    EXPECT_GT(mind.commands.yawRate[0], 0);
    mind.want(-10, 2.0F);
    EXPECT_TRUE(isForward(mind.think()));
    EXPECT_LT(mind.commands.yawRate[0], 0);
}

TEST(SecondaryController, inDangerItTurnsSharplyEarlier) {
    Mind calm;
    calm.want(60, 2.0F);
    EXPECT_EQ(calm.think(), motion::Action::TurnLeftGradual);
    Mind alarmed;
    alarmed.want(60, 2.0F, 1.5F);
    EXPECT_EQ(alarmed.think(), motion::Action::TurnLeftSharp);
}

TEST(SecondaryController, backwardsItKeepsTheSideOfTheTurnItIsIn) {
    Mind mind;
    mind.want(170, 2.0F);
    EXPECT_EQ(mind.think(), motion::Action::TurnLeftSharp);
    mind.states.segment[0] = static_cast<std::uint8_t>(motion::Action::TurnLeftGradual);
    mind.want(-175, 2.0F);
    EXPECT_EQ(mind.think(), motion::Action::TurnLeftSharp);
}

TEST(SecondaryController, whatATurnWillHaveDoneCounts) {
    for (const float degrees : {90.0F, 30.0F}) {
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
            motion::setSpeedBodyLengths(mind.states, 0, speed);
            mind.want(0, 1.6F);
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
