// SPDX-License-Identifier: Apache-2.0
// White text on dark boxes, over a finished picture.
#pragma once

#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"

namespace aquarama::show {

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

}  // namespace aquarama::show
