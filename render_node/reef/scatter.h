// SPDX-License-Identifier: Apache-2.0
// The colours of a reef: a few hues in harmony for each patch of it, and a rare accent.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/place/place.h"
#include "render_node/reef/growth.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/rock_mesh.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

// Linear albedo for a form that grows in a patch of the reef.
[[nodiscard]] glm::vec3 tintOf(Form form, std::uint32_t patch, Dice& dice);

// What stands where: the instances of all prototypes, from the place's rocks and a seed alone. Only
// seen, never felt: the master knows rocks and kelp from place.h.

// Rocks first, then each form's shapes.
inline constexpr std::size_t kPrototypes = kRockShapes + kForms * kShapesOfForm;
[[nodiscard]] constexpr std::size_t prototypeOf(Form form, int shape) {
    return kRockShapes + static_cast<std::size_t>(form) * kShapesOfForm +
           static_cast<std::size_t>(shape);
}

// 64 bytes, as instance.glsl reads them.
struct Instance {
    glm::vec4 placeAndScale{};   // world metres
    glm::vec4 turn{0, 0, 0, 1};  // quaternion x, y, z, w
    glm::vec4 tintAndSway{};     // linear albedo; w: share of the swell that its top follows
    glm::vec2 openness{1, 1};    // to sun and sky
    float sandHeightMetres = 0;
    std::uint32_t prototype = 0;
};
static_assert(sizeof(Instance) == 64);

// Sorted by prototype.
[[nodiscard]] std::vector<Instance> scatter(const place::PlaceKey& place,
                                            const std::array<Levels, kRockShapes>& rocks);

}  // namespace aquarama::scene
