// SPDX-License-Identifier: Apache-2.0
// Where a presented phase lies between two samples of the cycle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/motion/repertoire.h"

namespace aquarama::motion {

struct PhaseSample {
    std::size_t before = 0, after = 0;
    float share = 0.0F;  // of `after`
};

// A phase outside of [0, 1) plays its nearest end.
[[nodiscard]] inline PhaseSample sampleAt(float phase) {
    const float at = std::clamp(phase, 0.0F, 1.0F) * kPhases;
    const auto before = static_cast<std::size_t>(at);
    return {before % kPhases, (before + 1) % kPhases, at - static_cast<float>(before)};
}

[[nodiscard]] inline const ActionSegment& segmentOf(const Repertoire& repertoire,
                                                    std::uint32_t segment) {
    return repertoire.segments[std::min<std::size_t>(segment, kActions - 1)];
}

}  // namespace aquarama::motion
