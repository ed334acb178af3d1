// SPDX-License-Identifier: Apache-2.0
// The instances of a reef: which rocks, corals and plants stand where.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/place/place.h"
#include "render_node/reef/growth.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/strands.h"

namespace aquarama::scene {

// The instances of all prototypes, from the place's rocks and its seed alone. They are only drawn:
// the simulation knows the rocks and the kelp of common/place.

// Prototypes: first the shapes of rock, then those of each form.
inline constexpr std::size_t kPrototypes = kRockShapes + kForms * kShapesOfForm;
[[nodiscard]] constexpr std::size_t prototypeOf(Form form, int shape) {
    return kRockShapes + static_cast<std::size_t>(form) * kShapesOfForm +
           static_cast<std::size_t>(shape);
}

// One instance, as instance.glsl reads it: 64 bytes.
struct Instance {
    // Place of its foot, or of a rock's centre, in world metres; w: scale, metres.
    glm::vec4 placeAndScale{};
    // Rotation as a unit quaternion x, y, z, w.
    glm::vec4 turn{0, 0, 0, 1};
    // Linear albedo; w: share of the swell that its top follows.
    glm::vec4 tintAndSway{};
    // Sun visibility and ambient occlusion, 0 to 1.
    glm::vec2 occlusion{1, 1};
    // Height of the sand below it.
    float sandHeightMetres = 0;
    std::uint32_t prototype = 0;
};
static_assert(sizeof(Instance) == 64);

// All instances, sorted by prototype.
[[nodiscard]] std::vector<Instance> scatter(const place::PlaceKey& place);

// A tint for a form in a patch of the reef: linear Rec. 709 albedo. Each patch has a few hues in
// harmony; accents are rare.
[[nodiscard]] glm::vec3 tintOf(Form form, std::uint32_t patch, Dice& dice);

}  // namespace aquarama::scene
