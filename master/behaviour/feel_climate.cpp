// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel_climate.h"

#include <algorithm>

namespace aquarama::behaviour {

namespace {

// A temperature difference that weighs as much as all the light.
constexpr float kDegreesOfComfort = 10;
// A smaller difference between two places moves no fish.
constexpr float kNoticeable = 0.02F;

// Light and temperature at one height.
struct Ambient {
    float light, celsius;
};

Ambient ambientAt(const surroundings::Surroundings& around, float y) {
    return {surroundings::lightAt(around.climate, around.daylight, y),
            surroundings::celsiusAt(around.climate, y)};
}

// How far a place is outside what one habit likes; each habit concerns one end of one range.
float lackOf(fish::Like habit, const config::Habits& habits, const Ambient& ambient) {
    switch (habit) {
        case fish::kLikesBrightness:
            return static_cast<float>(habits.comfort.light.least) - ambient.light;
        case fish::kLikesDarkness:
            return ambient.light - static_cast<float>(habits.comfort.light.most);
        case fish::kLikesWarmth:
            return (static_cast<float>(habits.comfort.waterCelsius.least) - ambient.celsius) /
                   kDegreesOfComfort;
        case fish::kLikesCold:
            return (ambient.celsius - static_cast<float>(habits.comfort.waterCelsius.most)) /
                   kDegreesOfComfort;
        default:
            return -1;
    }
}

}  // namespace

void feelClimate(const surroundings::Surroundings& around,
                 const fish::SpeciesParameters& parameters,
                 std::uint8_t likes,
                 Senses& senses) {
    const Ambient here = ambientAt(around, senses.position.y);
    senses.climate.light = here.light;
    senses.climate.celsius = here.celsius;
    fish::Like worst = fish::kIsFemale;
    for (const fish::Like habit :
         {fish::kLikesBrightness, fish::kLikesDarkness, fish::kLikesWarmth, fish::kLikesCold}) {
        if ((likes & habit) == 0) continue;
        const float lack = lackOf(habit, parameters.habits, here);
        if (lack <= senses.climate.discomfort) continue;
        senses.climate.discomfort = lack;
        worst = habit;
    }
    if (senses.climate.discomfort <= -kNoticeable) return;  // at ease
    // Both change with depth alone, so the best place is at the top or at the bottom of the water.
    const place::Region& water = around.obstacles.water;
    const float atTop =
        lackOf(worst, parameters.habits, ambientAt(around, water.centre.y + water.halfExtent.y));
    const float atBottom =
        lackOf(worst, parameters.habits, ambientAt(around, water.centre.y - water.halfExtent.y));
    const float best = std::min(atTop, atBottom);
    if (senses.climate.discomfort - best > kNoticeable)
        senses.climate.betterUp = atTop < atBottom ? 1.0F : -1.0F;
}

}  // namespace aquarama::behaviour
