// SPDX-License-Identifier: Apache-2.0
// What goes on in the mind of a fish, written beside it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "render_node/show/text_overlay.h"

namespace aquarama::show {

// The fish that is watched, by its place in the school, and what the master last said of it; no
// lines yet where it has not.
struct WatchedMind {
    std::uint32_t fish = 0;
    std::vector<std::string> lines;
};

// Where a fish is in a picture.
struct FishPlace {
    glm::vec2 middle{};  // pixels from the top left corner
    float halfLengthPixels = 0;
};

// Brackets about the fish, and a box of text to the side where there is more room; lines that are
// too long for it go on below, and what does not fit the picture's height is left out.
[[nodiscard]] std::vector<Label> mindLabels(const FishPlace& fish,
                                            const WatchedMind& mind,
                                            glm::ivec2 pictureSize,
                                            float dotPixels);

}  // namespace aquarama::show
