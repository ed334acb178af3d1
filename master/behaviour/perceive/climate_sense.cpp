// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/climate_sense.h"

#include <algorithm>

#include "master/fish/minds.h"

namespace aquarama {

namespace {

constexpr float kDegreesOfComfort = 10;  // weigh as much as all the light there is
constexpr float kNoticeable = 0.02F;     // less difference between here and there moves no fish

struct Ambient {
    float light, celsius;
};

Ambient ambientAt(const Surroundings& around, float y) {
    return {lightAt(around.climate, around.daylight, y), celsiusAt(around.climate, y)};
}

// How far the ambient is outside what a habit likes; each habit minds one side of one range.
float lackOf(Like habit, const Habits& habits, const Ambient& ambient) {
    switch (habit) {
        case kLikesBrightness:
            return static_cast<float>(habits.light.least) - ambient.light;
        case kLikesDarkness:
            return ambient.light - static_cast<float>(habits.light.most);
        case kLikesWarmth:
            return (static_cast<float>(habits.waterCelsius.least) - ambient.celsius) /
                   kDegreesOfComfort;
        case kLikesCold:
            return (ambient.celsius - static_cast<float>(habits.waterCelsius.most)) /
                   kDegreesOfComfort;
        default:
            return -1;
    }
}

}  // namespace

void feelClimate(const Surroundings& around,
                 const Nature& nature,
                 std::uint8_t likes,
                 Senses& senses) {
    const Ambient here = ambientAt(around, senses.position.y);
    senses.light = here.light;
    senses.celsius = here.celsius;
    Like worst = kIsFemale;
    for (const Like habit : {kLikesBrightness, kLikesDarkness, kLikesWarmth, kLikesCold}) {
        if ((likes & habit) == 0) continue;
        const float lack = lackOf(habit, nature.habits, here);
        if (lack <= senses.discomfort) continue;
        senses.discomfort = lack;
        worst = habit;
    }
    if (senses.discomfort <= -kNoticeable) return;  // at ease
    // Light and warmth change with depth alone: the best place is the top or the bottom.
    const Region& water = around.obstacles.water;
    const float atTop =
        lackOf(worst, nature.habits, ambientAt(around, water.centre.y + water.halfExtent.y));
    const float atBottom =
        lackOf(worst, nature.habits, ambientAt(around, water.centre.y - water.halfExtent.y));
    const float best = std::min(atTop, atBottom);
    if (senses.discomfort - best > kNoticeable) senses.betterUp = atTop < atBottom ? 1.0F : -1.0F;
}

}  // namespace aquarama
