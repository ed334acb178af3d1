// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/climate_sense.h"

#include <algorithm>

#include "master/fish/minds.h"

namespace aquarama::behaviour {

namespace {

constexpr float kDegreesOfComfort = 10;  // weigh as much as all the light there is
constexpr float kNoticeable = 0.02F;     // less difference between here and there moves no fish

struct Ambient {
    float light, celsius;
};

Ambient ambientAt(const surroundings::Surroundings& around, float y) {
    return {surroundings::lightAt(around.climate, around.daylight, y),
            surroundings::celsiusAt(around.climate, y)};
}

// How far the ambient is outside what a habit likes; each habit minds one side of one range.
float lackOf(fish::Like habit, const config::Habits& habits, const Ambient& ambient) {
    switch (habit) {
        case fish::kLikesBrightness:
            return static_cast<float>(habits.light.least) - ambient.light;
        case fish::kLikesDarkness:
            return ambient.light - static_cast<float>(habits.light.most);
        case fish::kLikesWarmth:
            return (static_cast<float>(habits.waterCelsius.least) - ambient.celsius) /
                   kDegreesOfComfort;
        case fish::kLikesCold:
            return (ambient.celsius - static_cast<float>(habits.waterCelsius.most)) /
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
    senses.light = here.light;
    senses.celsius = here.celsius;
    fish::Like worst = fish::kIsFemale;
    for (const fish::Like habit :
         {fish::kLikesBrightness, fish::kLikesDarkness, fish::kLikesWarmth, fish::kLikesCold}) {
        if ((likes & habit) == 0) continue;
        const float lack = lackOf(habit, parameters.habits, here);
        if (lack <= senses.discomfort) continue;
        senses.discomfort = lack;
        worst = habit;
    }
    if (senses.discomfort <= -kNoticeable) return;  // at ease
    // Light and warmth change with depth alone: the best place is the top or the bottom.
    const place::Region& water = around.obstacles.water;
    const float atTop =
        lackOf(worst, parameters.habits, ambientAt(around, water.centre.y + water.halfExtent.y));
    const float atBottom =
        lackOf(worst, parameters.habits, ambientAt(around, water.centre.y - water.halfExtent.y));
    const float best = std::min(atTop, atBottom);
    if (senses.discomfort - best > kNoticeable) senses.betterUp = atTop < atBottom ? 1.0F : -1.0F;
}

}  // namespace aquarama::behaviour
