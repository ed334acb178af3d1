// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/growth.h"

#include "render_node/scene/growth_forms.h"

namespace aquarama::scene {

namespace {

// In the order of Form.
constexpr std::array<void (*)(Mesh&, std::size_t, Dice), kForms> kGrow{
    growStaghorn, growBush,     growFingers, growTable, growBrain,    growLobes,   growLeaves,
    growCrust,    growFan,      growWhips,   growTubes, growBarrel,   growLeather, growSoftTree,
    growAnemone,  growFeathers, growTurf,    growKelp,  growSeagrass,
};

}  // namespace

Levels grow(Form form, int shape) {
    const auto at = static_cast<std::size_t>(form);
    const std::uint32_t seed =
        hashOf(hashOf(static_cast<std::uint32_t>(at)), static_cast<std::uint32_t>(shape));
    Levels levels;
    for (std::size_t level = 0; level < kLevels; ++level)
        kGrow.at(at)(levels.at(level), level, Dice{seed});
    return levels;
}

}  // namespace aquarama::scene
