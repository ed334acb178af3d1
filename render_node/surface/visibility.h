// SPDX-License-Identifier: Apache-2.0
// Which fish a channel draws, and how finely (paper, section 6).
#pragma once

#include <array>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace aquarama {

// Planes of a view's frustum, inward, with unit normals where they have one.
struct Frustum {
    std::array<glm::vec4, 6> planes{};
};
// Depth zero to one, in either direction; the far plane may be at infinity.
[[nodiscard]] Frustum frustumOf(const glm::mat4& clipFromWorld);

// A single point, against the frustum enlarged by a margin on every side.
[[nodiscard]] bool reaches(const Frustum& frustum, glm::vec3 point, float marginMetres);

// From 0, the control mesh, to 2, by the angle that a fish fills at the shared eye. It depends on
// nothing that a channel has of its own, so that neighbours draw the same fish alike.
[[nodiscard]] int levelOfDetail(glm::vec3 sharedEyeMetres,
                                glm::vec3 centreMetres,
                                float lengthMetres);

}  // namespace aquarama
