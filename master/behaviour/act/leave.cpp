// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/place/angle.h"
#include "master/behaviour/act/home.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

constexpr int kHeights = 16;             // at which the water is tried
constexpr float kInside = 0.85F;         // of the water's half height
constexpr float kPerCelsius = 0.1F;      // a degree too warm or cold is as bad as a tenth of light
constexpr float kSlantMetres = 2.0F;     // the way up or down is not sought more steeply
constexpr float kTiePerMetre = 1.0e-3F;  // of two heights that suit as well the nearer

float beyond(const config::Span& span, float value) {
    return std::max(
        {0.0F, static_cast<float>(span.least) - value, value - static_cast<float>(span.most)});
}

// How ill the water at a height suits; 0: well.
float illAt(const Situation& situation, float y) {
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const config::Habits& habits = situation.parameters.habits;
    return beyond(habits.light, surroundings::lightAt(around.climate, around.daylight, y)) +
           kPerCelsius * beyond(habits.waterCelsius, surroundings::celsiusAt(around.climate, y));
}

}  // namespace

float suitableHeight(const Situation& situation) {
    const place::Region& water = situation.environment.surroundings->obstacles.water;
    const float own = situation.senses.position.y;
    float best = own;
    float least = illAt(situation, own);
    for (int i = 0; i <= kHeights; ++i) {
        const float share = 2 * static_cast<float>(i) / kHeights - 1;
        const float y = water.centre.y + share * kInside * water.halfExtent.y;
        const float ill = illAt(situation, y) + kTiePerMetre * std::abs(y - own);
        if (ill >= least) continue;
        least = ill;
        best = y;
    }
    return best;
}

fish::Course leave(const Situation& situation) {
    const Senses& senses = situation.senses;
    const float climb = suitableHeight(situation) - senses.position.y;
    const glm::vec3 about =
        boundFor(situation.environment, situation.parameters, situation.fish, senses.position)
            .towards;
    const glm::vec3 level = place::directionOf({about.x, 0, about.z}, senses.heading);
    const glm::vec3 desired = senses.heading * 0.5F + level * 0.5F +
                              glm::vec3{0, std::clamp(climb / kSlantMetres, -1.0F, 1.0F), 0};
    return heading(situation, desired, situation.parameters.slow);
}

}  // namespace aquarama::behaviour
