// SPDX-License-Identifier: Apache-2.0
// Text over a picture, for an operator at the wall.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/base/dot_font.h"
#include "render_node/gl/handle.h"

namespace aquarama::show {

// White text on dark boxes, drawn over a finished picture.

// One line of text.
struct Label {
    // Of the box, in pixels from the picture's top left corner.
    glm::vec2 topLeft{};
    // Characters that the font lacks are drawn as blanks.
    std::string text;
};

// The size of a line of text with its box, in dots.
[[nodiscard]] glm::vec2 extentInDots(const std::string& text);

// Owns its GL objects; construct, use and destroy with the same context current.
class TextOverlay {
  public:
    TextOverlay();
    // Draws the labels into the framebuffer of this size; dotPixels is the side of a dot.
    void draw(std::span<const Label> labels,
              unsigned framebuffer,
              glm::ivec2 sizePixels,
              float dotPixels);

  private:
    gl::ProgramHandle program_;
    gl::Buffer glyphs_;
    gl::VertexArray noVertices_;
};

// The overlay that shows the mind of a fish.

// The fish that is watched, as its index in the school, and what the master last said of it; no
// lines before the first answer.
struct WatchedMind {
    std::uint32_t fish = 0;
    std::vector<std::string> lines;
};

// Where a fish is in a picture.
struct FishPlace {
    // Pixels from the picture's top left corner.
    glm::vec2 middle{};
    float halfLengthPixels = 0;
};

// Labels for brackets around the fish, and for a box of text on the side that has more room. Lines
// that are too long are wrapped; lines beyond the picture's height are omitted.
[[nodiscard]] std::vector<Label> mindLabels(const FishPlace& fish,
                                            const WatchedMind& mind,
                                            glm::ivec2 pictureSize,
                                            float dotPixels);

}  // namespace aquarama::show
