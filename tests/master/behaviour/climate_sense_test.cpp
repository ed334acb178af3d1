// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "master/behaviour/feel_climate.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {
namespace {

// Water from 2 to 10 m deep; light falls by 0.02 and warmth by 0.5 degrees a metre.
struct Deep {
    Deep() {
        around.obstacles.water = {{0, -6, 0}, {5, 4, 5}};
        around.climate.surfaceCelsius = 28;
        around.climate.celsiusPerMetre = -0.5F;
        parameters.habits.comfort.light = {0.5, 0.7};
        parameters.habits.comfort.waterCelsius = {25, 26};
    }
    [[nodiscard]] Senses at(float depth, unsigned likes) const {
        Senses senses;
        senses.position = {0, -depth, 0};
        feelClimate(around, parameters, static_cast<std::uint8_t>(likes), senses);
        return senses;
    }
    surroundings::Surroundings around;
    fish::SpeciesParameters parameters;
};

TEST(Climate, aFishWithoutHabitsIsAtEaseAnywhere) {
    Deep deep;
    deep.around.daylight = 0.1F;
    EXPECT_LT(deep.at(9, fish::kIsFemale | fish::kLikesSchooling).climate.discomfort, 0);
}

TEST(Climate, lightAndWarmthAreThoseOfItsDepth) {
    const Senses senses = Deep().at(8, 0);
    EXPECT_NEAR(senses.climate.light, 0.84F, 1e-5F);
    EXPECT_NEAR(senses.climate.celsius, 24, 1e-4F);
}

TEST(Climate, whoLikesBrightnessOrWarmthWantsUpAndTheOthersDown) {
    Deep deep;
    deep.around.daylight = 0.55F;  // 0.44 at 10 m
    EXPECT_GT(deep.at(10, fish::kLikesBrightness).climate.discomfort, 0.05F);
    EXPECT_EQ(deep.at(10, fish::kLikesBrightness).climate.betterUp, 1);
    EXPECT_GT(deep.at(9, fish::kLikesWarmth).climate.discomfort, 0.1F);
    EXPECT_EQ(deep.at(9, fish::kLikesWarmth).climate.betterUp, 1);
    EXPECT_GT(deep.at(2.5F, fish::kLikesCold).climate.discomfort, 0);
    EXPECT_EQ(deep.at(2.5F, fish::kLikesCold).climate.betterUp, -1);
    deep.around.daylight = 0.8F;
    EXPECT_GT(deep.at(2, fish::kLikesDarkness).climate.discomfort, 0);
    EXPECT_EQ(deep.at(2, fish::kLikesDarkness).climate.betterUp, -1);
}

TEST(Climate, withinItsRangeAFishIsAtEase) {
    Deep deep;
    EXPECT_LT(deep.at(5, fish::kLikesBrightness | fish::kLikesWarmth).climate.discomfort, 0);
    EXPECT_EQ(deep.at(5, fish::kLikesBrightness | fish::kLikesWarmth).climate.betterUp, 0);
}

TEST(Climate, atNightNowhereIsBetterForWhoIsAtTheTop) {
    Deep deep;
    deep.around.daylight = 0.2F;
    const Senses senses = deep.at(2, fish::kLikesBrightness);
    EXPECT_GT(senses.climate.discomfort, 0.2F);
    EXPECT_EQ(senses.climate.betterUp, 0);
}

TEST(Climate, ofTwoThingsAmissTheWorseDecides) {
    Deep deep;
    deep.around.daylight = 0.75F;  // 0.72 at 2 m: a little bright
    const Senses senses = deep.at(9, fish::kLikesDarkness | fish::kLikesWarmth);
    EXPECT_EQ(senses.climate.betterUp, 1) << "too cold";
}

}  // namespace
}  // namespace aquarama::behaviour
