// SPDX-License-Identifier: Apache-2.0
// The published order of priorities, the roles, memory and persistence.
#include "master/behaviour/intention_generator.h"

#include <gtest/gtest.h>

#include "common/base/hash.h"
#include "tests/master/behaviour/fish_in_mind.h"

namespace aquarama::behaviour {
namespace {

// All that could be intended at once; from the top of the ladder one cause after another is taken
// away.
TEST(IntentionGenerator, keepsThePublishedOrderOfPrey) {
    FishInMind fish;
    fish.senses.urgency = 1.2F;
    fish.threaten(9);
    fish.frighten(0.9F, 0.9F);
    fish.feelings.hunger = 0.8F;
    fish.showFood(5);
    fish.senses.climate.discomfort = 0.3F;
    fish.senses.climate.betterUp = 1;
    EXPECT_EQ(fish.think(), fish::Intention::AvoidObstacle);
    fish.senses.urgency = 0;
    EXPECT_EQ(fish.think(), fish::Intention::AvoidFish);
    EXPECT_EQ(fish.mind.target, 9U);
    fish.clearTheWay();
    EXPECT_EQ(fish.think(), fish::Intention::Escape);
    EXPECT_EQ(fish.mind.target, 40U);
    fish.calm();
    EXPECT_EQ(fish.think(), fish::Intention::Eat);
    EXPECT_EQ(fish.mind.target, 5U);
    fish.feelings.hunger = 0.1F;
    EXPECT_EQ(fish.think(), fish::Intention::Leave);
    fish.senses.climate.discomfort = -0.5F;
    EXPECT_EQ(fish.think(), fish::Intention::School);
    fish.mind.likes = 0;
    EXPECT_EQ(fish.think(), fish::Intention::Wander);
}

TEST(IntentionGenerator, schoolsFromALesserFearAndFleesAloneFromAGreater) {
    FishInMind fish;
    fish.frighten(0.4F, 0.4F);
    EXPECT_EQ(fish.think(), fish::Intention::School);
    EXPECT_EQ(fish.mind.alarm, fish::Alarm::Together);
    fish.frighten(0.7F, 0.7F);
    EXPECT_EQ(fish.think(), fish::Intention::Escape);
    EXPECT_EQ(fish.mind.alarm, fish::Alarm::Alone);

    FishInMind many;  // predators, none of them near
    many.frighten(1, 0.5F);
    EXPECT_EQ(many.think(), fish::Intention::School);

    FishInMind lone;
    lone.senses.schoolmates.count = 0;
    lone.frighten(0.4F, 0.4F);
    EXPECT_EQ(lone.think(), fish::Intention::Escape) << "no school shelters it";

    FishInMind loner;
    loner.mind.likes = 0;
    loner.frighten(0.4F, 0.4F);
    EXPECT_EQ(loner.think(), fish::Intention::Escape);
}

TEST(IntentionGenerator, aPredatorNeverEscapesSchoolsMatesOrLeaves) {
    FishInMind shark(config::Role::Predator);
    shark.mind.likes = fish::kLikesSchooling;
    shark.frighten(1, 1);
    shark.feelings.libido = 1;
    shark.showMate(3);
    shark.senses.climate.discomfort = 0.5F;
    shark.senses.climate.betterUp = -1;
    EXPECT_EQ(shark.think(), fish::Intention::Wander);
    for (const PriorityRule rule :
         {PriorityRule::Fear, PriorityRule::Libido, PriorityRule::Climate, PriorityRule::Company})
        EXPECT_EQ(shark.rule(rule).verdict, Verdict::AgainstHabits);
}

TEST(IntentionGenerator, aPacifistNeitherEscapesNorSchoolsButMates) {
    FishInMind tang(config::Role::Pacifist);
    tang.mind.likes = fish::kLikesSchooling;
    tang.frighten(1, 1);
    EXPECT_EQ(tang.think(), fish::Intention::Wander);
    tang.feelings.libido = 0.4F;
    tang.showMate(3);
    EXPECT_EQ(tang.think(), fish::Intention::Mate);
    EXPECT_EQ(tang.mind.target, 3U);
}

TEST(IntentionGenerator, preyLeavesItsSchoolToMateIfItsSpeciesDoes) {
    FishInMind scad;
    scad.feelings.libido = 0.9F;
    scad.showMate(3);
    EXPECT_EQ(scad.think(), fish::Intention::School);
    scad.parameters.habits.libidoPerSecond = 0.003F;
    EXPECT_EQ(scad.think(), fish::Intention::Mate);
    scad.frighten(0.9F, 0.9F);
    EXPECT_EQ(scad.think(), fish::Intention::Escape);
}

TEST(IntentionGenerator, aHunterMatesWhileItRestsFromAChaseWhateverPreyIsInSight) {
    FishInMind grouper(config::Role::Predator);
    grouper.parameters.habits.libidoPerSecond = 0.003F;
    grouper.parameters.habits.hunt.restSeconds = grouper.parameters.habits.hunt.restByDaySeconds =
        60;
    grouper.feelings.hunger = 1;
    grouper.feelings.libido = 0.6F;
    grouper.showPrey(4);
    grouper.showMate(3);
    EXPECT_EQ(grouper.think(), fish::Intention::Eat) << "rested";
    grouper.mind = {};
    grouper.mind.sinceChase = 0;
    EXPECT_EQ(grouper.think(), fish::Intention::Mate);
}

TEST(IntentionGenerator, theStrongerOfHungerAndLibidoWins) {
    FishInMind hungry(config::Role::Pacifist);
    hungry.showFood(5);
    hungry.showMate(3);
    hungry.feelings = {.hunger = 0.6F, .libido = 0.5F};
    EXPECT_EQ(hungry.think(), fish::Intention::Eat);
    EXPECT_EQ(hungry.rule(PriorityRule::Libido).verdict, Verdict::Yields);

    FishInMind loving(config::Role::Pacifist);
    loving.showFood(5);
    loving.showMate(3);
    loving.feelings = {.hunger = 0.5F, .libido = 0.6F};
    EXPECT_EQ(loving.think(), fish::Intention::Mate);
    EXPECT_EQ(loving.rule(PriorityRule::Hunger).verdict, Verdict::Yields);
    loving.senses.mate = {};
    EXPECT_EQ(loving.think(), fish::Intention::Eat)
        << "nobody to mate with: the lesser wish has its way";
}

TEST(IntentionGenerator, ofAlmostEqualWishesThePresentOneIsKept) {
    FishInMind fish(config::Role::Pacifist);
    fish.showFood(5);
    fish.showMate(3);
    fish.feelings = {.hunger = 0.50F, .libido = 0.50F};
    const fish::Intention first = fish.think();
    for (int thought = 0; thought < 200; ++thought) {
        const float swing = (thought % 2 == 0 ? 0.09F : -0.09F);
        fish.feelings.hunger = 0.5F + swing;
        ASSERT_EQ(fish.think(), first);
    }
}

TEST(IntentionGenerator, anEvenMuchStrongerWishWaitsUntilThePresentOneHadItsTime) {
    FishInMind fish(config::Role::Pacifist);
    fish.showFood(5);
    fish.showMate(3);
    fish.feelings = {.hunger = 0.4F, .libido = 0.3F};
    fish.think();
    fish.feelings.libido = 0.9F;
    EXPECT_EQ(fish.thinkFor(1.5F), fish::Intention::Eat);
    EXPECT_EQ(fish.thinkFor(1.0F), fish::Intention::Mate);
}

TEST(Memory, whatACollisionInterruptsIsResumed) {
    for (const fish::Intention about : {fish::Intention::Eat, fish::Intention::Mate}) {
        FishInMind fish(config::Role::Pacifist);
        fish.showFood(5);
        fish.showMate(3);
        fish.feelings.hunger = about == fish::Intention::Eat ? 0.4F : 0.1F;
        fish.feelings.libido = about == fish::Intention::Mate ? 0.4F : 0.1F;
        ASSERT_EQ(fish.think(), about);
        const std::uint32_t target = fish.mind.target;
        fish.thinkFor(3);
        fish.threaten(9);
        EXPECT_EQ(fish.thinkFor(1), fish::Intention::AvoidFish);
        fish.senses.urgency = 2;  // and then an obstacle, before it could go on
        EXPECT_EQ(fish.thinkFor(1), fish::Intention::AvoidObstacle);
        fish.clearTheWay();
        EXPECT_EQ(fish.rule(PriorityRule::Memory).verdict, Verdict::Wins);
        EXPECT_EQ(fish.think(), about);
        EXPECT_EQ(fish.mind.target, target);
        EXPECT_GT(fish.mind.pursued, 5 * 60 - 60U) << "the interruption counts in";
        EXPECT_EQ(fish.mind.remembered, fish::Intention::Wander) << "memory is empty again";
    }
}

TEST(Memory, aFlightIsFollowedByWhatItInterrupted) {
    FishInMind fish;
    fish.feelings.hunger = 0.9F;
    fish.showFood(5);
    ASSERT_EQ(fish.think(), fish::Intention::Eat);
    fish.frighten(0.9F, 0.9F);
    ASSERT_EQ(fish.thinkFor(2), fish::Intention::Escape);
    fish.threaten(8);  // one item: the flight does not push out the meal
    ASSERT_EQ(fish.think(), fish::Intention::AvoidFish);
    fish.clearTheWay();
    fish.frighten(0.4F, 0.4F);
    ASSERT_EQ(fish.think(), fish::Intention::School);
    fish.calm();
    EXPECT_EQ(fish.rule(PriorityRule::Memory).verdict, Verdict::Wins);
    EXPECT_EQ(fish.think(), fish::Intention::Eat);
}

TEST(Memory, isDroppedWhenTheTargetIsGone) {
    FishInMind fish;
    fish.feelings.hunger = 0.9F;
    fish.showFood(5);
    fish.think();
    fish.threaten(9);
    fish.think();
    fish.clearTheWay();
    fish.senses.food = {};
    EXPECT_EQ(fish.rule(PriorityRule::Memory).verdict, Verdict::NoTarget);
    EXPECT_EQ(fish.think(), fish::Intention::School);
    EXPECT_EQ(fish.mind.remembered, fish::Intention::Wander);
}

TEST(Memory, isDroppedWhenTooOld) {
    FishInMind fish(config::Role::Pacifist);
    fish.feelings.libido = 0.9F;
    fish.showMate(3);
    fish.think();
    fish.threaten(9);
    fish.thinkFor(15);
    fish.clearTheWay();
    fish.feelings.libido = 0;
    EXPECT_EQ(fish.rule(PriorityRule::Memory).verdict, Verdict::TooOld);
    EXPECT_EQ(fish.think(), fish::Intention::Wander);
}

TEST(Persistence, aFlightEndsBelowTheFearThatBeganIt) {
    FishInMind fish;
    fish.frighten(0.24F, 0.24F);
    EXPECT_EQ(fish.think(), fish::Intention::School);
    EXPECT_EQ(fish.mind.alarm, fish::Alarm::Calm);
    fish.frighten(0.9F, 0.9F);
    fish.think();
    fish.frighten(0.5F, 0.5F);  // above 0.8 f1
    EXPECT_EQ(fish.think(), fish::Intention::Escape);
    fish.frighten(0.21F, 0.21F);  // above 0.8 f0
    fish.think();
    EXPECT_EQ(fish.mind.alarm, fish::Alarm::Together);
    fish.frighten(0.19F, 0.19F);
    fish.think();
    EXPECT_EQ(fish.mind.alarm, fish::Alarm::Calm);
}

TEST(Persistence, anObstacleIsAvoidedUntilItIsWellPast) {
    FishInMind fish;
    fish.senses.urgency = 0.9F;
    EXPECT_EQ(fish.think(), fish::Intention::School);
    fish.senses.urgency = 1.1F;
    EXPECT_EQ(fish.think(), fish::Intention::AvoidObstacle);
    fish.senses.urgency = 0.8F;
    EXPECT_EQ(fish.think(), fish::Intention::AvoidObstacle);
    fish.senses.urgency = 0.6F;
    EXPECT_EQ(fish.think(), fish::Intention::School);
}

TEST(Predator, chasesForATimeAndThenRests) {
    FishInMind shark(config::Role::Predator);
    shark.parameters.habits.hunt = {.chaseSeconds = 8, .giveUpMetres = 6, .restSeconds = 60};
    shark.feelings.hunger = 0.8F;
    shark.showPrey(4);
    EXPECT_EQ(shark.think(), fish::Intention::Eat);
    shark.thinkFor(3);
    shark.showPrey(6);  // another target is still the same chase
    shark.threaten(30);
    EXPECT_EQ(shark.thinkFor(1), fish::Intention::AvoidFish);
    shark.clearTheWay();
    EXPECT_EQ(shark.thinkFor(3), fish::Intention::Eat);
    EXPECT_EQ(shark.thinkFor(2), fish::Intention::Wander) << "more than 8 s";
    EXPECT_EQ(shark.rule(PriorityRule::Hunger).verdict, Verdict::Resting);
    EXPECT_EQ(shark.thinkFor(55), fish::Intention::Wander);
    EXPECT_EQ(shark.thinkFor(6), fish::Intention::Eat) << "rested";
}

TEST(Predator, thatIsSatedDoesNotHunt) {
    FishInMind shark(config::Role::Predator);
    shark.feelings.hunger = 0.2F;
    shark.showPrey(4);
    EXPECT_EQ(shark.think(), fish::Intention::Wander);
    EXPECT_EQ(shark.rule(PriorityRule::Hunger).verdict, Verdict::TooWeak);
}

// Whatever a mind meets, why it decided is what it decided, and one rule won.
TEST(Reasoning, tellsOfTheDecisionThatIsTaken) {
    std::uint32_t state = 1;
    const auto drawn = [&state] { return unitOf(state = hashOf(state + 1)); };
    for (int i = 0; i < 20'000; ++i) {
        const auto role = static_cast<config::Role>(state % 3);
        FishInMind fish(role);
        fish.senses.urgency = 1.3F * drawn();
        if (drawn() < 0.3F) fish.threaten(9, drawn());
        if (drawn() < 0.5F) fish.frighten(drawn(), 0.8F * drawn());
        if (drawn() < 0.6F) fish.showFood(5);
        if (drawn() < 0.6F) fish.showMate(6);
        if (drawn() < 0.6F) fish.showPrey(7);
        fish.feelings.hunger = drawn();
        fish.feelings.libido = drawn();
        fish.senses.climate.discomfort = drawn() - 0.7F;
        fish.senses.climate.betterUp = drawn() < 0.5F ? 1.0F : 0.0F;
        fish.mind.remembered = static_cast<fish::Intention>(drawn() < 0.5F ? 0 : 2 + 3 * drawn());
        fish.mind.rememberedTarget = 5;
        fish.mind.sinceRemembered = static_cast<std::uint32_t>(1200 * drawn());
        fish.mind.alarm = drawn() < 0.5F ? fish::Alarm::Calm : fish::Alarm::Alone;
        const Decision decision = decide(fish.parameters, fish.mind, fish.senses, fish.feelings);
        const Reasoning why = reason(fish.parameters, fish.mind, fish.senses, fish.feelings);
        ASSERT_EQ(why.decision.intention, decision.intention);
        ASSERT_EQ(why.decision.target, decision.target);
        ASSERT_EQ(why.decision.alarm, decision.alarm);
        for (std::size_t rule = 0; rule < kPriorityRules; ++rule) {
            const Verdict verdict = why.rules[rule].verdict;
            const auto winner = static_cast<std::size_t>(why.winner);
            ASSERT_EQ(verdict == Verdict::Wins, rule == winner);
            ASSERT_TRUE(verdict != Verdict::Outranked || rule > winner);
        }
    }
}

}  // namespace
}  // namespace aquarama::behaviour
