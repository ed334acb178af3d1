// SPDX-License-Identifier: Apache-2.0
// How much a frame may cost: what each tier of quality buys, in one place. All nodes of a wall draw
// at the same tier, or their pictures would part where they overlap.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace aquarama {

enum class QualityTier : std::uint8_t {
    Low,     // software OpenGL on two cores, live
    Medium,  // a small GPU; software OpenGL that may take its time
    High,    // a GPU of today
    Ultra,   // no expense spared: pictures, references
};
inline constexpr std::array<std::string_view, 4> kTierNames{"low", "medium", "high", "ultra"};

struct Quality {
    int samples = 1;  // of multisampling
    bool closeUps = false;      // fish that fill much of the picture are refined a third time
    float fishFineness = 1.0F;  // of fishes' meshes: detailLimits() of surface/visibility.h
};

[[nodiscard]] Quality qualityOf(QualityTier tier);

}  // namespace aquarama
