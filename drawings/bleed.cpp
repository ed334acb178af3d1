// SPDX-License-Identifier: Apache-2.0
#include "drawings/bleed.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace aquarama::drawings {

namespace {

// A picture whose texels are known in part: red, green and blue times the weight, and the weight,
// 0 to 1.
struct Level {
    glm::ivec2 size{};
    std::vector<glm::vec4> texels;

    // The border goes on.
    [[nodiscard]] const glm::vec4& at(int x, int y) const {
        const int row = glm::min(y, size.y - 1), column = glm::min(x, size.x - 1);
        return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(column)];
    }
};

// The texels of a disc about one.
std::vector<glm::ivec2> discOf(double radius) {
    const int reach = static_cast<int>(radius);
    std::vector<glm::ivec2> disc;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            if (x * x + y * y <= radius * radius) disc.emplace_back(x, y);
    return disc;
}

bool isCovered(const PngPicture& skin, glm::ivec2 texel) {
    if (texel != glm::clamp(texel, glm::ivec2(0), skin.sizePixels - 1)) return false;
    const auto at = static_cast<std::size_t>(texel.y * skin.sizePixels.x + texel.x);
    return skin.codes[4 * at + 3] != 0;
}

// Known is what lies deep within the outline.
Level levelOf(const PngPicture& skin, double rim) {
    const std::vector<glm::ivec2> disc = discOf(rim);
    Level level{skin.sizePixels, {}};
    for (int y = 0; y < skin.sizePixels.y; ++y)
        for (int x = 0; x < skin.sizePixels.x; ++x) {
            const std::size_t at = 4 * level.texels.size();
            const bool isDeep = std::ranges::all_of(disc, [&](glm::ivec2 to) {
                return isCovered(skin, glm::ivec2{x, y} + to);
            });
            level.texels.push_back(
                isDeep ? glm::vec4{skin.codes[at], skin.codes[at + 1], skin.codes[at + 2], 1}
                       : glm::vec4{});
        }
    return level;
}

// Half as large each way.
Level halved(const Level& fine) {
    Level coarse{glm::max(fine.size / 2, 1), {}};
    for (int y = 0; y < coarse.size.y; ++y)
        for (int x = 0; x < coarse.size.x; ++x) {
            const glm::vec4 sum = fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) +
                                  fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1);
            coarse.texels.push_back(sum.w > 1 ? sum / sum.w : sum);
        }
    return coarse;
}

// Between the four texels about the middle of a texel of the next finer level.
glm::vec4 between(const Level& coarse, int x, int y) {
    constexpr float kNear = 0.75F;
    const glm::ivec2 low = glm::max((glm::ivec2{x, y} - 1) / 2, 0);
    const glm::vec2 t{x == 0       ? 0
                      : x % 2 == 1 ? 1 - kNear
                                   : kNear,
                      y == 0       ? 0
                      : y % 2 == 1 ? 1 - kNear
                                   : kNear};
    return glm::mix(glm::mix(coarse.at(low.x, low.y), coarse.at(low.x + 1, low.y), t.x),
                    glm::mix(coarse.at(low.x, low.y + 1), coarse.at(low.x + 1, low.y + 1), t.x),
                    t.y);
}

// What is not known, by a coarser level of which all is.
void fill(Level& fine, const Level& coarse) {
    std::size_t at = 0;
    for (int y = 0; y < fine.size.y; ++y)
        for (int x = 0; x < fine.size.x; ++x, ++at)
            if (fine.texels[at].w < 1)
                fine.texels[at] += (1 - fine.texels[at].w) * between(coarse, x, y);
}

// The same, all of it known.
Level filled(const Level& level) {
    std::vector<Level> levels{level};
    while (levels.back().texels.size() > 1) levels.push_back(halved(levels.back()));
    glm::vec4& mean = levels.back().texels.front();
    if (mean.w > 0) mean /= mean.w;
    for (std::size_t i = levels.size() - 1; i > 0; --i) fill(levels[i - 1], levels[i]);
    return std::move(levels.front());
}

}  // namespace

// Of what was known, nothing changes.
void bleed(PngPicture& skin, double rim) {
    assert(skin.components == 4 && skin.bits == 8);
    const Level level = filled(levelOf(skin, rim));
    for (std::size_t at = 0; at < skin.codes.size(); at += 4)
        for (std::size_t c = 0; c < 3; ++c)
            skin.codes[at + c] =
                static_cast<std::uint16_t>(std::lround(level.texels[at / 4][static_cast<int>(c)]));
}

}  // namespace aquarama::drawings
