// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/visibility.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace aquarama {

namespace {

// Radians. A projector of the theatre shows 0.09 as some 160 pixels: six for a quad of the control
// mesh.
constexpr float kLevel1Angle = 0.09F;
constexpr float kLevel2Angle = 0.28F;

}  // namespace

Frustum frustumOf(const glm::mat4& clipFromWorld) {
    const glm::vec4 x = glm::row(clipFromWorld, 0), y = glm::row(clipFromWorld, 1);
    const glm::vec4 z = glm::row(clipFromWorld, 2), w = glm::row(clipFromWorld, 3);
    Frustum frustum{{w + x, w - x, w + y, w - y, z, w - z}};
    for (glm::vec4& plane : frustum.planes) {
        const float length = glm::length(glm::vec3(plane));
        if (length > 0.0F) plane /= length;  // none at infinity
    }
    return frustum;
}

bool reaches(const Frustum& frustum, glm::vec3 point, float marginMetres) {
    return std::ranges::all_of(frustum.planes, [&](const glm::vec4& plane) {
        return glm::dot(glm::vec3(plane), point) + plane.w >= -marginMetres;
    });
}

int levelOfDetail(glm::vec3 sharedEyeMetres, glm::vec3 centreMetres, float lengthMetres) {
    const float distance = glm::distance(sharedEyeMetres, centreMetres);
    if (lengthMetres > kLevel2Angle * distance) return 2;
    return lengthMetres > kLevel1Angle * distance ? 1 : 0;
}

}  // namespace aquarama
