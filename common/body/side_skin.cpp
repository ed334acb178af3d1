// SPDX-License-Identifier: Apache-2.0
#include "common/body/side_skin.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/body/side_view.h"

namespace aquarama::body {

namespace {

static_assert(kSideTexels.x == 1 << (kSideLevels - 1) && kSideTexels.y <= kSideTexels.x);

// The light of each code, and between each code and the next the light where rounding changes.
struct Codes {
    std::array<float, 256> light{};
    std::array<float, 255> between{};
};
const Codes& codes() {
    static const Codes all = [] {
        Codes made;
        for (std::size_t i = 0; i < made.light.size(); ++i)
            made.light.at(i) = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 255));
        for (std::size_t i = 0; i < made.between.size(); ++i)
            made.between.at(i) =
                static_cast<float>(linearFromSrgb((static_cast<double>(i) + 0.5) / 255));
        return made;
    }();
    return all;
}

std::uint8_t codeOf(float light) {
    const auto& between = codes().between;
    return static_cast<std::uint8_t>(std::ranges::upper_bound(between, light) - between.begin());
}

// Means of two by two; where there is one row left, of two by one.
std::vector<glm::vec3> halved(const std::vector<glm::vec3>& fine, std::size_t level) {
    const glm::ivec2 from = sideTexelsAt(level - 1), to = sideTexelsAt(level);
    const auto at = [&](int x, int y) {
        return fine[static_cast<std::size_t>(std::min(y, from.y - 1) * from.x + x)];
    };
    std::vector<glm::vec3> coarse;
    coarse.reserve(static_cast<std::size_t>(to.x * to.y));
    for (int y = 0; y < to.y; ++y)
        for (int x = 0; x < to.x; ++x)
            coarse.push_back(0.25F * (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) +
                                      at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1)));
    return coarse;
}

std::vector<glm::u8vec4> encoded(const std::vector<glm::vec3>& light) {
    std::vector<glm::u8vec4> texels;
    texels.reserve(light.size());
    for (const glm::vec3& one : light)
        texels.emplace_back(codeOf(one.r), codeOf(one.g), codeOf(one.b), 255);
    return texels;
}

}  // namespace

glm::ivec2 sideTexelsAt(std::size_t level) {
    return glm::max(kSideTexels >> static_cast<int>(level), glm::ivec2(1));
}

SideSkin sideSkinOf(std::span<const std::byte> png, const std::string& source) {
    const PngPicture picture = beginsAsSkin(png) ? decodePng(png, source) : PngPicture{};
    if (picture.sizePixels != kSideTexels || picture.components != 3)
        throw Error(source + ": a skin has " + std::to_string(kSideTexels.x) + " x " +
                    std::to_string(kSideTexels.y) +
                    " pixels of red, green and blue in 8 bits; "
                    "read the sheet again");
    std::vector<glm::vec3> light(picture.codes.size() / 3);
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int c = 0; c < 3; ++c)
            light[i][c] = codes().light[picture.codes[3 * i + static_cast<std::size_t>(c)]];
    SideSkin skin;
    for (std::size_t level = 0; level < kSideLevels; ++level) {
        if (level > 0) light = halved(light, level);
        skin.levels.at(level) = encoded(light);
    }
    return skin;
}

}  // namespace aquarama::body
