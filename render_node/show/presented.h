// SPDX-License-Identifier: Apache-2.0
// A frame's food and clock as the scene takes them, and its fish for those who point at them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/motion/reconstruct.h"
#include "common/wire/state_codec.h"
#include "render_node/scene/scene.h"

namespace aquarama::show {

// The school at the frame's moment. Records beyond the school that was welcomed are left out.
// It takes its time with all of them: the scene itself presents fish on the GPU.
[[nodiscard]] std::vector<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school);
// One of them by its place in the school, if there is such a one.
[[nodiscard]] std::optional<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school, std::size_t place);

// The food at the frame's moment: a particle that another takes the place of never glides to it.
void presentFood(const wire::StateFrame& frame, std::vector<scene::FoodParticle>& food);

// Since tick 0.
[[nodiscard]] double presentedSeconds(const wire::StateFrame& frame);

[[nodiscard]] glm::dmat4 wallFromWorld(const wire::Eye& eye);

}  // namespace aquarama::show
