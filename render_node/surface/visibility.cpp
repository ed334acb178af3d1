// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/visibility.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace aquarama::surface {

namespace {

// Pixels, by level. A control mesh has 26 rings along the fish: where the next level takes over, at
// 60 pixels, its quads are about 2 pixels long, and so on for the finer levels.
constexpr DetailLimits kLimits{0.0F, 2.5F, 4.0F, 20.0F, 60.0F, 180.0F, 600.0F};
// A level looks entirely like itself at this multiple of its limit.
constexpr float kMorph = 1.35F;

}  // namespace

// Gribb and Hartmann: each plane is a sum or difference of rows of the matrix.
FrustumPlanes frustumOf(const glm::mat4& clipFromWorld) {
    const glm::vec4 x = glm::row(clipFromWorld, 0), y = glm::row(clipFromWorld, 1);
    const glm::vec4 z = glm::row(clipFromWorld, 2), w = glm::row(clipFromWorld, 3);
    FrustumPlanes frustum{{w + x, w - x, w + y, w - y, z, w - z}};
    for (glm::vec4& plane : frustum.planes) {
        const float length = glm::length(glm::vec3(plane));
        // The plane at infinity has no normal.
        if (length > 0.0F) plane /= length;
    }
    return frustum;
}

bool FrustumPlanes::sees(glm::vec3 centre, float radius) const {
    return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
        return glm::dot(glm::vec3(plane), centre) + plane.w >= -radius;
    });
}

DetailLimits detailLimits(float fineness) {
    assert(fineness > 0.0F);
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
    assert(finest <= DetailLevel::CloseUp);
    assert(view.pixelRadians > 0.0F);
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
    // Half the size of a point, in pixels, with a margin.
    constexpr float kPixels = 3.0F;
    return reachBodyLengths * lengthMetres +
           kPixels * view.pixelRadians * glm::distance(view.eyeMetres, placeMetres);
}

}  // namespace aquarama::surface
