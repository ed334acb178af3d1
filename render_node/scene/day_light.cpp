// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/day_light.h"

#include <array>
#include <cstddef>

#include <glm/common.hpp>

namespace aquarama::scene {

namespace {

// The colour of the light at a time of day, a multiplier of its strength.
struct Key {
    float timeOfDay;
    DayLight light;
};
// The phases of common/place/day.h. Noon is white. Between two keys the light changes by a
// smoothstep.
constexpr std::array kKeys{
    Key{0.000F, {{1.10F, 1.60F, 2.00F}, {0.12F, 0.33F, 0.58F}, 0.55F}},  // night: the moon
    Key{0.085F, {{1.10F, 1.60F, 2.00F}, {0.12F, 0.33F, 0.58F}, 0.55F}},
    Key{0.125F, {{0.95F, 0.92F, 0.98F}, {1.15F, 0.96F, 1.12F}, 0.75F}},  // first light: grey-blue
    Key{0.175F, {{1.30F, 0.70F, 1.05F}, {1.05F, 0.66F, 1.20F}, 0.80F}},  // dawn: blue-violet
    Key{0.225F, {{1.40F, 0.84F, 0.95F}, {1.05F, 0.80F, 1.15F}, 0.90F}},
    Key{0.300F, {{0.82F, 0.92F, 1.08F}, {0.78F, 0.92F, 1.16F}, 1.00F}},  // morning: clear
    Key{0.350F, {{0.82F, 0.92F, 1.08F}, {0.78F, 0.92F, 1.16F}, 1.00F}},
    Key{0.430F, {}},  // noon
    Key{0.570F, {}},
    Key{0.660F, {{1.45F, 1.03F, 0.74F}, {1.06F, 0.91F, 0.98F}, 1.00F}},  // afternoon: warm
    Key{0.730F, {{1.70F, 1.04F, 0.62F}, {1.12F, 0.84F, 0.98F}, 1.00F}},
    Key{0.765F, {{2.50F, 1.15F, 0.40F}, {1.20F, 0.70F, 1.02F}, 0.90F}},  // sunset: gold
    Key{0.805F, {{1.90F, 0.72F, 0.80F}, {1.05F, 0.60F, 1.00F}, 0.70F}},  // then rose and blue
    Key{0.850F, {{0.95F, 0.40F, 0.80F}, {0.40F, 0.40F, 1.00F}, 0.35F}},  // dusk: deep blue
    Key{0.900F, {{1.10F, 1.60F, 2.00F}, {0.12F, 0.33F, 0.58F}, 0.55F}},
    Key{1.000F, {{1.10F, 1.60F, 2.00F}, {0.12F, 0.33F, 0.58F}, 0.55F}},
};

// The strength of the light before its colour: of the sun (x) and the sky's red, green and blue
// (yzw). When the sun is low the surface reflects its light away; what remains is bluer and comes
// from above.
constexpr glm::vec3 kDarkestSky{0.16F, 0.24F, 0.36F};
constexpr float kDarkestSun = 0.02F;

template <class Value>
Value between(Value before, Value after, float share) {
    return before + (after - before) * share;
}

// The colour alone.
DayLight colourAt(float timeOfDay) {
    std::size_t next = 1;
    while (next + 1 < kKeys.size() && kKeys[next].timeOfDay <= timeOfDay) ++next;
    const Key& before = kKeys[next - 1];
    const Key& after = kKeys[next];
    const float share = glm::smoothstep(before.timeOfDay, after.timeOfDay, timeOfDay);
    return {between(before.light.sun, after.light.sun, share),
            between(before.light.sky, after.light.sky, share),
            between(before.light.lamp, after.light.lamp, share)};
}

}  // namespace

DayLight dayLightAt(float timeOfDay, float daylight) {
    const DayLight colour = colourAt(timeOfDay);
    const float sun = glm::mix(kDarkestSun, 1.0F, daylight * daylight);
    const glm::vec3 sky = glm::mix(kDarkestSky, glm::vec3{1.0F}, glm::vec3{daylight});
    return {colour.sun * sun, colour.sky * sky, colour.lamp};
}

}  // namespace aquarama::scene
