// SPDX-License-Identifier: Apache-2.0
// What single fish draw from the ranges of their species.
#include <gtest/gtest.h>

#include "master/behaviour/think.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {
namespace {

constexpr std::uint32_t kTemperedFish = 20'000;

double shareOf(const fish::SpeciesParameters& parameters, std::uint8_t like) {
    std::uint32_t have = 0;
    for (std::uint32_t fish = 0; fish < kTemperedFish; ++fish)
        have += (likesOf(parameters, 9, fish, 0.2F) & like) != 0 ? 1 : 0;
    return static_cast<double>(have) / kTemperedFish;
}

// Five standard errors of a share of so many fish are 0.018.
TEST(Temperament, sharesOfHabitsAreThoseOfTheSpecies) {
    fish::SpeciesParameters parameters;
    parameters.habits.shares = {.schooling = 0.9, .brightness = 0.5, .warmth = 0.25, .female = 0.6};
    EXPECT_NEAR(shareOf(parameters, fish::kLikesSchooling), 0.9, 0.018);
    EXPECT_NEAR(shareOf(parameters, fish::kLikesBrightness), 0.5, 0.018);
    EXPECT_NEAR(shareOf(parameters, fish::kLikesWarmth), 0.25, 0.018);
    EXPECT_NEAR(shareOf(parameters, fish::kIsFemale), 0.6, 0.018);
    EXPECT_EQ(shareOf(parameters, fish::kLikesDarkness), 0);
    EXPECT_EQ(shareOf(parameters, fish::kLikesCold), 0);
}

TEST(Temperament, whoWouldLikeBothOfAPairLikesNeither) {
    fish::SpeciesParameters parameters;
    parameters.habits.shares = {.brightness = 0.5, .darkness = 0.5, .warmth = 1, .cold = 1};
    for (std::uint32_t fish = 0; fish < 1000; ++fish) {
        const unsigned likes = likesOf(parameters, 4, fish, 0.2F);
        constexpr unsigned kLight = fish::kLikesBrightness | fish::kLikesDarkness;
        EXPECT_NE(likes & kLight, kLight);
        EXPECT_EQ(likes & (fish::kLikesWarmth | fish::kLikesCold), 0U);
    }
    // Of those who draw one half the other half draw the other too.
    EXPECT_NEAR(shareOf(parameters, fish::kLikesBrightness), 0.25, 0.018);
}

TEST(Temperament, isTheSeedsAndTheFishsOwn) {
    fish::SpeciesParameters parameters;
    parameters.habits.shares = {
        .schooling = 0.5, .brightness = 0.5, .darkness = 0.5, .warmth = 0.5};
    int same = 0;
    int sameOfAnotherSeed = 0;
    for (std::uint32_t fish = 0; fish < 1000; ++fish) {
        EXPECT_EQ(likesOf(parameters, 1, fish, 0.2F), likesOf(parameters, 1, fish, 0.2F));
        same +=
            likesOf(parameters, 1, fish, 0.2F) == likesOf(parameters, 1, fish + 1, 0.2F) ? 1 : 0;
        sameOfAnotherSeed +=
            likesOf(parameters, 1, fish, 0.2F) == likesOf(parameters, 2, fish, 0.2F) ? 1 : 0;
    }
    EXPECT_LT(same, 150) << "four coins agree once in sixteen times";
    EXPECT_LT(sameOfAnotherSeed, 150);
}

TEST(Temperament, notAllHungerAtOnce) {
    const fish::SpeciesParameters parameters;
    int hungry = 0;
    for (std::uint32_t fish = 0; fish < 1000; ++fish) {
        fish::Mind mind = freshMind(parameters, 3, fish, 0.2F);
        for (int second = 0; second < 60; ++second)
            for (int thought = 0; thought < 7; ++thought)
                fish::passTime(parameters, fish::kTicksBetweenThoughts, mind);
        hungry += feel(parameters, mind, {}).hunger > fish::kDesire ? 1 : 0;
    }
    // A minute of the 250 s that a meal lasts.
    EXPECT_GT(hungry, 150);
    EXPECT_LT(hungry, 350);
}

TEST(Mood, beginsAsTheSceneWantsIt) {
    fish::SpeciesParameters parameters;
    parameters.habits.role = config::Role::Pacifist;
    parameters.habits.libidoPerSecond = 0.003F;
    for (const float hunger : {0.0F, 0.2F, 0.7F, 1.0F}) {
        for (const float libido : {0.0F, 0.3F, 0.8F}) {
            fish::Mind mind;
            fish::setMood(parameters, hunger, libido, mind);
            const fish::Feelings feelings = feel(parameters, mind, {});
            EXPECT_NEAR(feelings.hunger, hunger, 0.01F);
            // Who hungers wholly has no libido, whatever the scene says.
            const float most = std::min(libido, 1 - hunger);
            EXPECT_NEAR(feelings.libido, most, 0.01F) << hunger << " and " << libido;
        }
    }
}

TEST(Mood, holdsForEveryAppetite) {
    for (const float appetite : {0.5F, 1.0F, 2.5F, 6.0F}) {
        fish::SpeciesParameters parameters;
        parameters.habits.hunger.appetiteParticles = appetite;
        fish::Mind mind;
        fish::setMood(parameters, 0.4F, 0, mind);
        EXPECT_NEAR(feel(parameters, mind, {}).hunger, 0.4F, 0.01F) << appetite;
    }
}

}  // namespace
}  // namespace aquarama::behaviour
