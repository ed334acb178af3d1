// SPDX-License-Identifier: Apache-2.0
// The colours of a reef: a few hues in harmony for each patch of it, and a rare accent.
#pragma once

#include <glm/vec3.hpp>

#include "render_node/scene/growth.h"
#include "render_node/scene/solid_noise.h"

namespace aquarama::scene {

// Linear albedo for a form that grows in a patch of the reef.
[[nodiscard]] glm::vec3 tintOf(Form form, std::uint32_t patch, Dice& dice);

}  // namespace aquarama::scene
