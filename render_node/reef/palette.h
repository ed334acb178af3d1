// SPDX-License-Identifier: Apache-2.0
// The colours of what grows on a reef.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "render_node/reef/growth.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

// A tint for a form in a patch of the reef: linear Rec. 709 albedo. Each patch has a few hues in
// harmony; accents are rare.
[[nodiscard]] glm::vec3 tintOf(Form form, std::uint32_t patch, Dice& dice);

}  // namespace aquarama::scene
