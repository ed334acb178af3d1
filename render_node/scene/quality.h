// SPDX-License-Identifier: Apache-2.0
// How much a frame may cost: what each tier of quality buys, in one place.
#pragma once

#include "common/config/quality.h"

namespace aquarama {

struct Quality {
    int samples = 1;            // of multisampling
    bool softening = false;     // of the distance, by forward scattering: 32 fetches a pixel
    bool bloom = false;         // 18 fetches a pixel, and smaller copies of the picture
    bool closeUps = false;      // fish that fill much of the picture are refined a third time
    float fishFineness = 1.0F;  // of fishes' meshes: detailLimits() of surface/visibility.h
    // How finely the place is cut: at 1 a facet of a coral fills some 7 of the wall's finest
    // pixels.
    float placeDetail = 1.0F;
    int rockScales = 1;           // of the grit on rock, 1 to 3; above 1 laid on from three sides
    bool growthAtPixels = false;  // near corals are lit at pixels, not at corners
};

[[nodiscard]] Quality qualityOf(QualityTier tier);

}  // namespace aquarama
