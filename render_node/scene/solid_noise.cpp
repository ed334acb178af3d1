// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/solid_noise.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace aquarama::scene {

float solidNoise(std::uint32_t seed, glm::vec3 place) {
    const glm::vec3 cell = glm::floor(place);
    const glm::vec3 t = place - cell;
    const glm::vec3 s = t * t * (3.0F - 2.0F * t);
    const glm::ivec3 at{cell};
    const auto corner = [&](int x, int y, int z) {
        const std::uint32_t column = hashOf(seed, static_cast<std::uint32_t>(at.x + x));
        const std::uint32_t row = hashOf(column, static_cast<std::uint32_t>(at.y + y));
        return signedUnitOf(hashOf(row, static_cast<std::uint32_t>(at.z + z)));
    };
    const auto plane = [&](int z) {
        return glm::mix(glm::mix(corner(0, 0, z), corner(1, 0, z), s.x),
                        glm::mix(corner(0, 1, z), corner(1, 1, z), s.x),
                        s.y);
    };
    return glm::mix(plane(0), plane(1), s.z);
}

float billows(std::uint32_t seed, glm::vec3 place, int octaves) {
    float sum = 0.0F;
    float height = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * solidNoise(seed, place);
        place = place * 2.03F + 7.1F;
        height *= 0.5F;
    }
    return sum;
}

float ridges(std::uint32_t seed, glm::vec3 place, int octaves) {
    float sum = 0.0F;
    float height = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * (1.0F - 2.0F * std::abs(solidNoise(seed, place)));
        place = place * 2.1F + 3.7F;
        height *= 0.5F;
    }
    return sum;
}

glm::mat3 frameAbout(glm::vec3 up, float turnRadians) {
    const glm::vec3 away = std::abs(up.y) < 0.99F ? glm::vec3{0, 1, 0} : glm::vec3{1, 0, 0};
    const glm::vec3 x = glm::normalize(glm::cross(away, up));
    const glm::vec3 z = glm::cross(x, up);
    const float c = std::cos(turnRadians);
    const float s = std::sin(turnRadians);
    return {x * c + z * s, up, z * c - x * s};
}

}  // namespace aquarama::scene
