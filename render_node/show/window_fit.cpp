// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/window_fit.h"

#include <algorithm>
#include <cassert>

#include <glm/vector_relational.hpp>

namespace aquarama::show {

WindowFit fitInto(glm::ivec2 windowPixels, glm::ivec2 picturePixels) {
    assert(picturePixels.x > 0);
    assert(picturePixels.y > 0);
    const glm::vec2 size(picturePixels);
    const glm::vec2 room = glm::vec2(windowPixels) / size;
    const glm::ivec2 fitted(size * std::min(room.x, room.y));
    return {(windowPixels - fitted) / 2, fitted};
}

std::optional<glm::vec2> picturePlace(glm::ivec2 windowPixels,
                                      glm::ivec2 picturePixels,
                                      glm::vec2 windowPlace) {
    const WindowFit fit = fitInto(windowPixels, picturePixels);
    const glm::vec2 topLeft(fit.corner.x, windowPixels.y - fit.corner.y - fit.size.y);
    const glm::vec2 share = (windowPlace - topLeft) / glm::vec2(fit.size);
    // Written so that a NaN counts as outside.
    const bool inside = glm::all(glm::greaterThanEqual(share, glm::vec2(0))) &&
                        glm::all(glm::lessThan(share, glm::vec2(1)));
    if (!inside) return std::nullopt;
    return share * glm::vec2(picturePixels);
}

}  // namespace aquarama::show
