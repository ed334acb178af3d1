// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel/mental_state.h"

#include <algorithm>

#include "common/units/ids.h"

namespace aquarama {

namespace {

float seconds(std::uint32_t ticks) {
    return static_cast<float>(ticks) / static_cast<float>(kTicksPerSecond);
}

}  // namespace

Feelings feel(const Nature& nature, const Mind& mind, const Senses& senses) {
    Feelings feelings;
    const float left = std::max(0.0F, 1 - nature.digestion * seconds(mind.sinceMeal));
    feelings.hunger =
        std::clamp(1 - static_cast<float>(mind.eaten) * left / nature.appetite, 0.0F, 1.0F);
    feelings.libido =
        std::clamp(nature.libido * seconds(mind.sinceSpawning) * (1 - feelings.hunger), 0.0F, 1.0F);
    for (std::size_t i = 0; i < senses.predatorCount; ++i) {
        const float fear = std::min(nature.fearMetres / senses.predators[i].distance, 1.0F);
        feelings.fear = std::min(1.0F, feelings.fear + fear);
        feelings.greatestFear = std::max(feelings.greatestFear, fear);
    }
    return feelings;
}

}  // namespace aquarama
