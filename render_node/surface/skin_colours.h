// SPDX-License-Identifier: Apache-2.0
// The colours of a skin shader, for programs that draw fish without a GPU.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/body/fish_body.h"
#include "common/skin/limit_table.h"

namespace aquarama::surface {

// For each place linear albedo and opacity, without light and water. eye: place s, y and radius,
// body lengths. Needs a current context; throws Error where the driver cannot compile the shader.
[[nodiscard]] std::vector<glm::vec4> skinColours(const body::FishSkin& skin,
                                                 std::span<const skin::SkinPlace> places);

}  // namespace aquarama::surface
