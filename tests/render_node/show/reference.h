// SPDX-License-Identifier: Apache-2.0
// The last pass in plain C++ and doubles: what project.frag is held against.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render_node/show/projection.h"

namespace aquarama::show {

// A picture in linear light, top row first.
struct LightPicture {
    glm::ivec2 size{};
    std::vector<float> rgb;

    [[nodiscard]] glm::dvec3 at(glm::ivec2 pixel) const {
        const glm::ivec2 inside = glm::clamp(pixel, glm::ivec2(0), size - 1);
        const float* sample = &rgb[static_cast<std::size_t>(inside.y * size.x + inside.x) * 3];
        return {sample[0], sample[1], sample[2]};
    }
    // Bilinear; the coordinate has its origin at the bottom left.
    [[nodiscard]] glm::dvec3 sample(glm::dvec2 coordinate) const {
        const glm::dvec2 place =
            glm::dvec2(coordinate.x, 1 - coordinate.y) * glm::dvec2(size) - 0.5;
        const glm::ivec2 corner(glm::floor(place));
        const glm::dvec2 share = place - glm::floor(place);
        const auto row = [&](int y) {
            return glm::mix(at({corner.x, y}), at({corner.x + 1, y}), share.x);
        };
        return glm::mix(row(corner.y), row(corner.y + 1), share.y);
    }
};

inline double srgbOf(double linear) {
    const double clamped = std::clamp(linear, 0.0, 1.0);
    return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
}

inline std::array<std::uint32_t, 3> pcg3d(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    x = x * 1664525U + 1013904223U;
    y = y * 1664525U + 1013904223U;
    z = z * 1664525U + 1013904223U;
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16U;
    y ^= y >> 16U;
    z ^= z >> 16U;
    x += y * z;
    y += z * x;
    z += x * y;
    return {x, y, z};
}

inline int ditheredCode(double value, std::uint32_t random) {
    const double code = value * 255;
    const double first = (random & 0xFFFFU) / 65536.0;
    const double second = (random >> 16U) / 65536.0;
    const bool atAnEnd = code < 0.5 || code > 254.5;
    return static_cast<int>(std::floor(code + (atAnEnd ? first : first + second - 0.5)));
}

// The projector's light before it is encoded.
inline glm::dvec3 projectedLight(const ProjectionMap& map,
                                 const LightPicture& scene,
                                 std::size_t pixel) {
    const glm::dvec4 place(map.placeAndWeight[pixel]);
    return scene.sample(glm::dvec2(place)) * place.z;
}

}  // namespace aquarama::show
