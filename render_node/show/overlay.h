// SPDX-License-Identifier: Apache-2.0
// Digits, capitals and a few signs of 5 x 7 dots, for what an operator reads on the wall.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"

namespace aquarama::show {

inline constexpr std::size_t kGlyphColumns = 5;
inline constexpr std::size_t kGlyphRows = 7;

// One bit a dot, row by row from the top left.
using GlyphBits = std::uint64_t;
[[nodiscard]] GlyphBits glyphOf(char character);  // nothing for what it does not know

// White text on dark boxes, over a finished picture.

struct Label {
    glm::vec2 topLeft{};  // pixels from the picture's top left corner
    std::string text;     // what the font has; the rest is blank
};

// The size of a text in dots, with the box around it.
[[nodiscard]] glm::vec2 extentInDots(const std::string& text);

// Owns its GL objects; construct, use and destroy with the same context current.
class TextOverlay {
  public:
    TextOverlay();
    void draw(std::span<const Label> labels,
              unsigned framebuffer,
              glm::ivec2 sizePixels,
              float dotPixels);

  private:
    gl::ProgramHandle program_;
    gl::Buffer glyphs_;
    gl::VertexArray noVertices_;
};

// What goes on in the mind of a fish, written beside it.

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
