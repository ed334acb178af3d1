// SPDX-License-Identifier: Apache-2.0
// A channel's picture in a window of another size: the whole picture, enlarged or reduced, in the
// middle.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

namespace aquarama::show {

// A rectangle in pixels of the window.
struct WindowFit {
    // The lower left corner, from the window's lower left corner.
    glm::ivec2 corner{};
    glm::ivec2 size{};
};
// The largest rectangle with the picture's proportions that fits into the window.
[[nodiscard]] WindowFit fitInto(glm::ivec2 windowPixels, glm::ivec2 picturePixels);

// Converts a place of the window to a place of the picture, both in pixels from the top left
// corner; empty on the dark margins.
[[nodiscard]] std::optional<glm::vec2> picturePlace(glm::ivec2 windowPixels,
                                                    glm::ivec2 picturePixels,
                                                    glm::vec2 windowPlace);

}  // namespace aquarama::show
