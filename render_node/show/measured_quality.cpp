// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/measured_quality.h"

namespace aquarama {

QualityTier finestWithin(double budgetSeconds, const FrameCost& cost) {
    QualityTier finest = QualityTier::Low;
    for (std::uint32_t i = 0; i < kTierNames.size(); ++i) {
        const QualityTier tier = *tierAt(i);
        if (cost(tier) > budgetSeconds) break;
        finest = tier;
    }
    return finest;
}

}  // namespace aquarama
