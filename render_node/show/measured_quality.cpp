// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/measured_quality.h"

namespace aquarama::show {

config::QualityTier finestWithin(double budgetSeconds, const FrameCost& cost) {
    config::QualityTier finest = config::QualityTier::Low;
    for (std::uint32_t i = 0; i < config::kTierNames.size(); ++i) {
        const config::QualityTier tier = *config::tierAt(i);
        if (cost(tier) > budgetSeconds) break;
        finest = tier;
    }
    return finest;
}

}  // namespace aquarama::show
