// SPDX-License-Identifier: Apache-2.0
// The pixels of a triangle.
#pragma once

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::film {

// Twice the area of the triangle, positive where y is down and a, b, c turn clockwise on the
// screen.
[[nodiscard]] inline float doubleArea(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Calls paint(x, y, weights of the corners) for the pixels of a picture of this size whose centres
// the triangle holds. Corners are in pixels.
template <typename Paint>
void fillTriangle(const std::array<glm::vec2, 3>& corners, glm::ivec2 size, const Paint& paint) {
    const float area = doubleArea(corners[0], corners[1], corners[2]);
    if (area == 0) return;
    const glm::vec2 least = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::vec2 most = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::ivec2 first = glm::max(glm::ivec2(0), glm::ivec2(glm::floor(least)));
    const glm::ivec2 last = glm::min(size - 1, glm::ivec2(glm::ceil(most)));
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const glm::vec2 at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            const glm::vec3 weights{doubleArea(corners[1], corners[2], at) / area,
                                    doubleArea(corners[2], corners[0], at) / area,
                                    doubleArea(corners[0], corners[1], at) / area};
            if (std::min({weights.x, weights.y, weights.z}) >= 0) paint(x, y, weights);
        }
}

}  // namespace aquarama::film
