// SPDX-License-Identifier: Apache-2.0
// What a frame of the master shows at its moment between two ticks: fish, food, time, and where the
// submarine is.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include "common/motion/reconstruct.h"
#include "common/wire/state_codec.h"
#include "render_node/scene/scene.h"

namespace aquarama::show {

// The school at the frame's moment. Records beyond the school of the welcome message are ignored.
// Slow for a large school: it is for overlays; the scene interpolates fish on the GPU.
[[nodiscard]] std::vector<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school);
// One fish by its index in the school; empty where there is none.
[[nodiscard]] std::optional<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school, std::size_t place);

// Replaces `food` by the particles at the frame's moment, world frame. A particle that has replaced
// another between the ticks does not glide from its place.
void presentFood(const wire::StateFrame& frame, std::vector<scene::FoodParticle>& food);

// Time of the frame's moment since tick 0, seconds; never negative.
[[nodiscard]] double presentedSeconds(const wire::StateFrame& frame);

// From the world to the wall's frame, which moves with the submarine; metres.
[[nodiscard]] glm::dmat4 wallFromWorld(const wire::Eye& eye);

}  // namespace aquarama::show
