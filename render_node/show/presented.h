// SPDX-License-Identifier: Apache-2.0
// A frame's fish and clock as the scene takes them.
#pragma once

#include <span>
#include <vector>

#include "common/motion/reconstruct.h"
#include "common/wire/messages.h"
#include "render_node/scene/scene.h"

namespace aquarama {

// The school at the frame's moment. Records beyond the school that was welcomed are left out.
[[nodiscard]] std::vector<PresentedFish> presentedFish(const StateFrame& frame,
                                                       std::span<const FishTraits> school);

// The food at the frame's moment: a particle that another takes the place of never glides to it.
[[nodiscard]] std::vector<FoodParticle> presentedFood(const StateFrame& frame);

// Since tick 0.
[[nodiscard]] double presentedSeconds(const StateFrame& frame);

[[nodiscard]] glm::dmat4 wallFromWorld(const Eye& eye);

}  // namespace aquarama
