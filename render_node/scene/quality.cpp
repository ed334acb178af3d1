// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/quality.h"

#include <array>
#include <cstddef>

namespace aquarama {

Quality qualityOf(QualityTier tier) {
    static constexpr std::array<Quality, kTierNames.size()> kTiers{
        Quality{.samples = 1, .placeDetail = 0.5F},
        Quality{.samples = 1,
                .softening = true,
                .bloom = true,
                .placeDetail = 0.9F,
                .rockScales = 2,
                .growthAtPixels = true},
        Quality{.samples = 4,
                .softening = true,
                .bloom = true,
                .closeUps = true,
                .fishFineness = 1.25F,
                .placeDetail = 1.4F,
                .rockScales = 3,
                .growthAtPixels = true},
        Quality{.samples = 4,
                .softening = true,
                .bloom = true,
                .closeUps = true,
                .fishFineness = 1.6F,
                .placeDetail = 2.5F,
                .rockScales = 3,
                .growthAtPixels = true},
    };
    return kTiers.at(static_cast<std::size_t>(tier));
}

}  // namespace aquarama
