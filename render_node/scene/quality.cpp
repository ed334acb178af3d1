// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/quality.h"

#include <array>
#include <cstddef>

namespace aquarama {

Quality qualityOf(QualityTier tier) {
    static constexpr std::array<Quality, kTierNames.size()> kTiers{
        Quality{.samples = 1},
        Quality{.samples = 1},
        Quality{.samples = 4, .closeUps = true, .fishFineness = 1.25F},
        Quality{.samples = 4, .closeUps = true, .fishFineness = 1.6F},
    };
    return kTiers.at(static_cast<std::size_t>(tier));
}

}  // namespace aquarama
