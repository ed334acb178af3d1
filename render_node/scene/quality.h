// SPDX-License-Identifier: Apache-2.0
// How much a frame may cost: what each tier of quality buys, in one place.
#pragma once

#include "common/config/quality.h"

namespace aquarama {

struct Quality {
    int samples = 1;  // of multisampling
    bool closeUps = false;      // fish that fill much of the picture are refined a third time
    float fishFineness = 1.0F;  // of fishes' meshes: detailLimits() of surface/visibility.h
};

[[nodiscard]] Quality qualityOf(QualityTier tier);

}  // namespace aquarama
