// SPDX-License-Identifier: Apache-2.0
// A frame's fish and clock as the scene takes them.
#pragma once

#include <span>
#include <vector>

#include "common/motion/reconstruct.h"
#include "common/wire/messages.h"

namespace aquarama {

// The school at the frame's moment. Records beyond the school that was welcomed are left out.
[[nodiscard]] std::vector<PresentedFish> presentedFish(const StateFrame& frame,
                                                       std::span<const FishTraits> school);

// Since tick 0.
[[nodiscard]] double presentedSeconds(const StateFrame& frame);

[[nodiscard]] glm::dmat4 wallFromWorld(const Eye& eye);

}  // namespace aquarama
