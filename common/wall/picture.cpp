// SPDX-License-Identifier: Apache-2.0
#include "common/wall/picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

#include "common/units/hash.h"

namespace aquarama::wall {

namespace {

// The middle of one of 2^32 equal parts of (0, 1).
double unit(std::uint32_t bits) {
    return (bits + 0.5) / 4294967296.0;
}

// A table, since pow() for each pixel would take seconds.
std::vector<float> lightOfEveryCode(int bits) {
    std::vector<float> table(std::size_t{1} << bits);
    for (std::size_t code = 0; code < table.size(); ++code)
        table[code] = static_cast<float>(
            linearFromSrgb(static_cast<double>(code) / static_cast<double>(table.size() - 1)));
    return table;
}

// most: the largest code. Below one code of light the noise shrinks with the light, so that black
// stays black.
std::uint16_t codeOf(double linear, double most, double noise) {
    const double exact = srgbFromLinear(std::clamp(linear, 0.0, 1.0)) * most;
    const double code = exact + noise * std::min(1.0, exact);
    return static_cast<std::uint16_t>(std::clamp(std::floor(code + 0.5), 0.0, most));
}

}  // namespace

Light darkness(glm::ivec2 sizePixels) {
    assert(sizePixels.x >= 0 && sizePixels.y >= 0);
    const auto count =
        static_cast<std::size_t>(sizePixels.x) * static_cast<std::size_t>(sizePixels.y);
    Light light;
    light.sizePixels = sizePixels;
    light.rgb.assign(count, glm::vec3(0));
    return light;
}

double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double ditherCodes(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    const std::uint32_t pixel = hashOf(x + hashOf(y + hashOf(seed)));
    return unit(pixel) + unit(hashOf(pixel + 1)) - 1;
}

Light lightOf(const Picture& picture) {
    assert(picture.bits == 8 || picture.bits == 16);
    const std::vector<float> table = lightOfEveryCode(picture.bits);
    Light light = darkness(picture.sizePixels);
    assert(picture.rgb.size() == 3 * light.rgb.size());
    for (std::size_t i = 0; i < light.rgb.size(); ++i)
        light.rgb[i] = {table[picture.rgb[3 * i]],
                        table[picture.rgb[3 * i + 1]],
                        table[picture.rgb[3 * i + 2]]};
    return light;
}

Picture pictureOf(const Light& light, int bits, std::uint32_t ditherSeed) {
    assert(bits == 8 || bits == 16);
    const double most = (1 << bits) - 1;
    Picture picture;
    picture.sizePixels = light.sizePixels;
    picture.bits = bits;
    picture.rgb.reserve(3 * light.rgb.size());
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 0; x < light.sizePixels.x; ++x)
            for (int c = 0; c < 3; ++c) {
                // Each colour has noise of its own.
                const auto column = static_cast<std::uint32_t>(3 * x + c);
                const double noise =
                    bits == 8 ? ditherCodes(column, static_cast<std::uint32_t>(y), ditherSeed) : 0;
                const auto linear = static_cast<double>(light.at(x, y)[c]);
                picture.rgb.push_back(codeOf(linear, most, noise));
            }
    return picture;
}

glm::vec3 bilinear(const Light& light, glm::dvec2 pixel) {
    assert(!light.rgb.empty());
    const glm::dvec2 last(light.sizePixels - 1);
    const glm::dvec2 at = glm::clamp(pixel - 0.5, glm::dvec2(0), last);
    const glm::ivec2 low(at);
    const glm::ivec2 high = glm::min(low + 1, light.sizePixels - 1);
    const glm::vec2 t(at - glm::dvec2(low));
    return glm::mix(glm::mix(light.at(low.x, low.y), light.at(high.x, low.y), t.x),
                    glm::mix(light.at(low.x, high.y), light.at(high.x, high.y), t.x),
                    t.y);
}

}  // namespace aquarama::wall
