// SPDX-License-Identifier: Apache-2.0
// Pictures as they are stored (sRGB codes) and as light (linear), and the one pair of functions
// between the two.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::wall {

// Codes of 8 or 16 bits, red green blue, top row first.
struct Picture {
    glm::ivec2 sizePixels{};
    int bits = 8;
    std::vector<std::uint16_t> rgb;
};

// Linear Rec. 709, 1 is a projector's full white; top row first.
struct Light {
    glm::ivec2 sizePixels{};
    std::vector<glm::vec3> rgb;

    [[nodiscard]] const glm::vec3& at(int x, int y) const { return rgb[index(x, y)]; }
    [[nodiscard]] glm::vec3& at(int x, int y) { return rgb[index(x, y)]; }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(sizePixels.x) +
               static_cast<std::size_t>(x);
    }
};
[[nodiscard]] Light darkness(glm::ivec2 sizePixels);

// IEC 61966-2-1, both ways between 0 and 1.
[[nodiscard]] double srgbFromLinear(double linear);
[[nodiscard]] double linearFromSrgb(double encoded);

// Triangular noise of one code either way, the same for the same pixel and seed.
[[nodiscard]] double ditherCodes(std::uint32_t x, std::uint32_t y, std::uint32_t seed);

[[nodiscard]] Light lightOf(const Picture& picture);
// 8 bits are dithered, 16 bits only rounded. Black stays black.
[[nodiscard]] Picture pictureOf(const Light& light, int bits, std::uint32_t ditherSeed);

// Between the centres of pixels, which are at +0.5; the border's colour goes on outside.
[[nodiscard]] glm::vec3 bilinear(const Light& light, glm::dvec2 pixel);

}  // namespace aquarama::wall
