// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/visibility.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace aquarama::surface {

namespace {

// By level, pixels. A control mesh has 26 rings, so that its quads are 2 pixels wide where the mesh
// takes over, as are the mesh's where the hero does, and so on.
constexpr DetailLimits kLimits{0.0F, 2.5F, 4.0F, 14.0F, 60.0F, 180.0F, 600.0F};
constexpr float kMorph = 1.35F;  // a level is all its own at so many times its limit

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

bool Frustum::sees(glm::vec3 centre, float radius) const {
    return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
        return glm::dot(glm::vec3(plane), centre) + plane.w >= -radius;
    });
}

DetailLimits detailLimits(float fineness) {
    DetailLimits limits = kLimits;
    for (auto level = std::size_t(DetailLevel::ControlMesh); level < limits.size(); ++level)
        limits[level] /= fineness;
    return limits;
}

Detail detailOf(const SharedView& view,
                const DetailLimits& limits,
                DetailLevel finest,
                glm::vec3 placeMetres,
                float lengthMetres) {
    const float pixels =
        lengthMetres / (glm::distance(view.eyeMetres, placeMetres) * view.pixelRadians);
    std::size_t level = 0;
    while (level < std::size_t(finest) && pixels >= limits[level + 1]) ++level;
    const auto chosen = static_cast<DetailLevel>(level);
    if (chosen == DetailLevel::Point) return {chosen, 0.0F};
    if (chosen == DetailLevel::FewTriangles) return {chosen, 1.0F};
    const float from = limits[level];
    const float to = chosen == DetailLevel::Fading ? limits[level + 1] : kMorph * from;
    const float t = glm::clamp((pixels - from) / (to - from), 0.0F, 1.0F);
    return {chosen, t * t * (3.0F - 2.0F * t)};
}

float marginOf(const SharedView& view,
               glm::vec3 placeMetres,
               float lengthMetres,
               float reachBodyLengths) {
    constexpr float kPixels = 3.0F;
    return reachBodyLengths * lengthMetres +
           kPixels * view.pixelRadians * glm::distance(view.eyeMetres, placeMetres);
}

}  // namespace aquarama::surface
