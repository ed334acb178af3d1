// SPDX-License-Identifier: Apache-2.0
// How a channel's picture lies in a window of another size: the whole of it, in the middle.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

namespace aquarama::show {

struct WindowFit {
    glm::ivec2 corner{};  // the lower left one, from the window's lower left
    glm::ivec2 size{};
};
[[nodiscard]] WindowFit fitInto(glm::ivec2 windowPixels, glm::ivec2 picturePixels);

// What a place of the window shows of the picture, both in pixels from the top left; nothing on the
// dark beside it.
[[nodiscard]] std::optional<glm::vec2> picturePlace(glm::ivec2 windowPixels,
                                                    glm::ivec2 picturePixels,
                                                    glm::vec2 windowPlace);

}  // namespace aquarama::show
