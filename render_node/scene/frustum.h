// SPDX-License-Identifier: Apache-2.0
// What a view can see of balls and of levels of detail.
#pragma once

#include <array>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace aquarama::scene {

class Frustum {
  public:
    explicit Frustum(const glm::mat4& clipFromWorld) {
        const glm::mat4 rows = glm::transpose(clipFromWorld);
        planes_ = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]};
        for (glm::vec4& plane : planes_) plane /= glm::length(glm::vec3(plane));
    }
    [[nodiscard]] bool sees(glm::vec3 centre, float radius) const {
        for (const glm::vec4& plane : planes_)
            if (glm::dot(glm::vec3(plane), centre) + plane.w < -radius) return false;
        return true;
    }

  private:
    std::array<glm::vec4, 4> planes_;  // the sides; things before and behind are few
};

// The first limit that a range does not reach.
template <std::size_t Limits>
[[nodiscard]] constexpr std::size_t levelAt(float range, const std::array<float, Limits>& limits) {
    std::size_t level = 0;
    while (level < Limits && range >= limits[level]) ++level;
    return level;
}

// How a frame is drawn: the same choice on every node, as it depends on the shared eye alone.
struct Viewpoint {
    Frustum frustum;
    glm::vec3 eyeMetres{};
    bool culling = true;
    bool levelsOfDetail = true;
    float detail = 1.0F;  // of the tier of quality

    [[nodiscard]] bool sees(glm::vec3 centre, float radius) const {
        return !culling || frustum.sees(centre, radius);
    }
    // 0 the finest; further than limits[i] is level i + 1.
    template <std::size_t Limits>
    [[nodiscard]] std::size_t levelOf(glm::vec3 place, std::array<float, Limits> limits) const {
        if (!levelsOfDetail) return 0;
        return levelAt(glm::distance(place, eyeMetres) / detail, limits);
    }
};

}  // namespace aquarama::scene
