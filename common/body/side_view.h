// SPDX-License-Identifier: Apache-2.0
// Where a picture of a species, drawn by a visitor as seen from its right side, lies on the body:
// the one definition for who makes such a skin and who shows it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "common/body/fish_body.h"

namespace aquarama::body {

// Size of such a skin: red, green, blue, alpha; sRGB codes, straight alpha, top row first.
inline constexpr glm::ivec2 kSideTexels{1024, 512};

// The rectangle of the rest frame that the skin covers: x anterior from the nose, y dorsal, body
// lengths (for metres, times the length of the fish). A place (s, y) of the rest shape is at
// (-s, y). The head is on the right.
struct SideView {
    glm::vec2 least{}, most{};

    // Texel coordinates, in texels from the upper left corner; centres of texels are at +0.5.
    [[nodiscard]] glm::vec2 texelAt(glm::vec2 rest) const {
        const glm::vec2 share = (rest - least) / (most - least);
        return glm::vec2{share.x, 1 - share.y} * glm::vec2{kSideTexels};
    }
    // The inverse: from texels to the rest frame.
    [[nodiscard]] glm::vec2 restAt(glm::vec2 texel) const {
        const glm::vec2 share = texel / glm::vec2{kSideTexels};
        return glm::mix(least, most, glm::vec2{share.x, 1 - share.y});
    }
};

// The smallest rectangle of the skin's proportions about cage and threads at rest, and 2 % more on
// either side.
[[nodiscard]] inline SideView sideViewOf(const FishBody& body) {
    SideView view{glm::vec2{1e9F}, glm::vec2{-1e9F}};
    const auto include = [&view](glm::vec2 at) {
        view.least = glm::min(view.least, glm::vec2{-at.x, at.y});
        view.most = glm::max(view.most, glm::vec2{-at.x, at.y});
    };
    for (const CageVertex& vertex : body.cage.vertices) include(glm::vec2{vertex.rest});
    for (const BodyThread& thread : body.threads)
        for (const glm::vec2 at : thread.at) include(at);
    const glm::vec2 centre = (view.least + view.most) / 2.0F, size = view.most - view.least;
    const float aspect = static_cast<float>(kSideTexels.x) / static_cast<float>(kSideTexels.y);
    const float half = 0.52F * std::max(size.x, aspect * size.y);
    return {centre - glm::vec2{half, half / aspect}, centre + glm::vec2{half, half / aspect}};
}

// Whether a file begins as the PNG of a skin does, of kSideTexels in 8 bits. Nothing is decoded, so
// what comes from others is asked first.
[[nodiscard]] bool beginsAsSkin(std::span<const std::byte> png);

}  // namespace aquarama::body
