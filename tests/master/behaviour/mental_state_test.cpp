// SPDX-License-Identifier: Apache-2.0
// Hunger, libido and fear over time, against their closed forms.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "master/behaviour/perceive.h"
#include "master/behaviour/think.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {
namespace {

constexpr float kThoughtSeconds = static_cast<float>(fish::kTicksBetweenThoughts) / 60;

fish::SpeciesParameters tang() {
    fish::SpeciesParameters parameters;
    parameters.habits.role = config::Role::Pacifist;
    parameters.habits.hunger.appetiteParticles = 3;
    parameters.habits.hunger.digestionPerSecond = 0.0045F;
    parameters.habits.libidoPerSecond = 0.003F;
    parameters.habits.fear.metres = 0.9F;
    return parameters;
}

fish::Mind fed(std::uint16_t particles) {
    fish::Mind mind;
    mind.eaten = particles;
    mind.sinceMeal = 0;
    mind.sinceSpawning = 0;
    return mind;
}

Senses lonely() {
    Senses senses;
    senses.length = 0.2F;
    return senses;
}

void see(Senses& senses, float predatorMetres, bool hunting = true) {
    senses.predators[senses.predatorCount++] = {7, {predatorMetres, 0, 0}, predatorMetres, hunting};
}

TEST(Hunger, risesAsTheMealIsDigestedAndIsOneWhenItIs) {
    const fish::SpeciesParameters parameters = tang();
    fish::Mind mind = fed(3);
    for (int thought = 1; thought < 2500; ++thought) {
        fish::passTime(parameters, fish::kTicksBetweenThoughts, mind);
        const float seconds = static_cast<float>(thought) * kThoughtSeconds;
        const float expected =
            std::min(1.0F, parameters.habits.hunger.digestionPerSecond * seconds);
        ASSERT_NEAR(feel(parameters, mind, lonely()).hunger, expected, 2e-5F) << seconds << " s";
    }
    EXPECT_EQ(mind.eaten, 0) << "a digested meal does not count again with the next";
}

TEST(Hunger, dropsByOneShareOfTheAppetiteWithEachParticle) {
    const fish::SpeciesParameters parameters = tang();
    fish::Mind mind = fed(0);
    for (const float expected : {1.0F, 2.0F / 3, 1.0F / 3, 0.0F}) {
        EXPECT_NEAR(feel(parameters, mind, lonely()).hunger, expected, 1e-6F);
        ++mind.eaten;
    }
}

TEST(Hunger, isTemptedByFoodNearbyUntilGorged) {
    const fish::SpeciesParameters parameters = tang();
    Senses senses = lonely();
    senses.food = {5, {0.2F, 0, 0}, 2 * senses.length};
    EXPECT_NEAR(feel(parameters, fed(6), senses).hunger, 0.8F, 1e-6F) << "a_h S_h alone";
    EXPECT_EQ(feel(parameters, fed(7), senses).hunger, 0) << "more than twice the appetite";
    senses.food.distance = 9 * senses.length;
    EXPECT_EQ(feel(parameters, fed(6), senses).hunger, 0) << "too far off to tempt";
}

TEST(Hunger, aPredatorIsNotTempted) {
    fish::SpeciesParameters parameters = tang();
    parameters.habits.role = config::Role::Predator;
    Senses senses = lonely();
    senses.food = {5, {0.2F, 0, 0}, senses.length};
    EXPECT_EQ(feel(parameters, fed(3), senses).hunger, 0);
}

TEST(Stimulus, followsThePublishedRampAndItsInverse) {
    EXPECT_EQ(stimulusOf(kFoodStimulus, 8.1F), 0);
    EXPECT_EQ(stimulusOf(kFoodStimulus, 1.9F), 1);
    EXPECT_NEAR(stimulusOf(kFoodStimulus, 8), 0, 1e-6F);
    EXPECT_NEAR(stimulusOf(kFoodStimulus, 2), 1, 1e-6F);
    // q1 = 1/8, q2 = 1/2, s = 1/4: (1/8) / (1 - 1/8 - 1/4) = 1/5.
    EXPECT_NEAR(stimulusOf(kFoodStimulus, 4), 0.2F, 1e-6F);
    EXPECT_NEAR(stimulusOf(kMateStimulus, 8), 0.2F, 1e-6F);
    for (const float stimulus : {0.1F, 0.3125F, 0.7F, 1.0F})
        EXPECT_NEAR(
            stimulusOf(kMateStimulus, bodyLengthsOf(kMateStimulus, stimulus)), stimulus, 1e-5F);
    EXPECT_EQ(bodyLengthsOf(kFoodStimulus, 1.01F), 0) << "no distance gives so much";
}

TEST(Libido, growsToOneWithTimeAndIsSuppressedByHunger) {
    const fish::SpeciesParameters parameters = tang();
    fish::Mind mind = fed(3);
    for (int thought = 1; thought <= 3000; ++thought) {
        fish::passTime(parameters, fish::kTicksBetweenThoughts, mind);
        const float seconds = static_cast<float>(thought) * kThoughtSeconds;
        const fish::Feelings feelings = feel(parameters, mind, lonely());
        const float grown = std::min(1.0F, parameters.habits.libidoPerSecond * seconds);
        ASSERT_NEAR(feelings.libido, grown * (1 - feelings.hunger), 2e-5F) << seconds << " s";
    }
    mind.eaten = 0;
    EXPECT_EQ(feel(parameters, mind, lonely()).libido, 0) << "the hungry think of food alone";
}

TEST(Libido, isRaisedByAMateInSight) {
    const fish::SpeciesParameters parameters = tang();
    Senses senses = lonely();
    senses.mate = {5, {0.8F, 0, 0}, 4 * senses.length};
    EXPECT_NEAR(feel(parameters, fed(3), senses).libido, 0.5F, 1e-6F) << "a_l S_l alone";
}

TEST(Libido, isOfSpeciesThatMateAndAtTheirHours) {
    fish::SpeciesParameters parameters = tang();
    fish::Mind mind = fed(3);
    mind.sinceSpawning = fish::kLongAgo;
    Senses senses = lonely();
    senses.mate = {5, {0.8F, 0, 0}, 4 * senses.length};
    for (const config::Role role :
         {config::Role::Prey, config::Role::Pacifist, config::Role::Predator}) {
        parameters.habits.role = role;
        senses.hour.mates = true;
        EXPECT_GT(feel(parameters, mind, senses).libido, 0.25F);
        senses.hour.mates = false;
        EXPECT_EQ(feel(parameters, mind, senses).libido, 0);
    }
    parameters.habits.libidoPerSecond = 0;
    senses.hour.mates = true;
    EXPECT_EQ(feel(parameters, mind, senses).libido, 0);
}

TEST(Libido, ofAHungryHunterIsHalf) {
    fish::SpeciesParameters parameters = tang();
    fish::Mind mind = fed(0);
    mind.sinceSpawning = fish::kLongAgo;
    EXPECT_EQ(fish::innerLibido(parameters, mind, 1), 0);
    parameters.habits.role = config::Role::Predator;
    EXPECT_FLOAT_EQ(fish::innerLibido(parameters, mind, 1), 0.5F);
}

TEST(Fear, addsUpOverThePredatorsInSightAndIsCutAtOne) {
    const fish::SpeciesParameters parameters = tang();
    Senses senses = lonely();
    EXPECT_EQ(feel(parameters, fed(3), senses).fear, 0);
    see(senses, 3.0F);
    EXPECT_NEAR(feel(parameters, fed(3), senses).fear, 0.3F, 1e-6F);
    see(senses, 4.5F);
    const fish::Feelings two = feel(parameters, fed(3), senses);
    EXPECT_NEAR(two.fear, 0.5F, 1e-6F);
    EXPECT_NEAR(two.greatestFear, 0.3F, 1e-6F);
    see(senses, 0.5F);
    const fish::Feelings three = feel(parameters, fed(3), senses);
    EXPECT_EQ(three.fear, 1);
    EXPECT_EQ(three.greatestFear, 1) << "nearer than D0 frightens wholly and no more";
}

TEST(Fear, ofAPredatorThatHuntsNobodyIsHalf) {
    const fish::SpeciesParameters parameters = tang();
    Senses hunted = lonely();
    see(hunted, 1.5F, true);
    Senses watched = lonely();
    see(watched, 1.5F, false);
    EXPECT_FLOAT_EQ(feel(parameters, fed(3), watched).fear,
                    0.5F * feel(parameters, fed(3), hunted).fear);
}

}  // namespace
}  // namespace aquarama::behaviour
