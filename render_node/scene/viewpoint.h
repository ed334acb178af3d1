// SPDX-License-Identifier: Apache-2.0
// From where a frame is seen, and how finely.
#pragma once

#include <array>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "render_node/surface/visibility.h"

namespace aquarama::scene {

// The first limit that a range does not reach.
template <std::size_t Limits>
[[nodiscard]] constexpr std::size_t levelAt(float range, const std::array<float, Limits>& limits) {
    std::size_t level = 0;
    while (level < Limits && range >= limits[level]) ++level;
    return level;
}

// How a frame is drawn: the same choice on every node, as it depends on the shared eye alone.
struct Viewpoint {
    surface::Frustum frustum;
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
