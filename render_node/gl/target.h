// SPDX-License-Identifier: Apache-2.0
// A picture that can be drawn into, bound as a texture and read back.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"

namespace aquarama::gl {

class Target {
  public:
    Target(GLenum format, glm::ivec2 sizePixels);
    [[nodiscard]] unsigned framebuffer() const { return framebuffer_.name(); }
    [[nodiscard]] unsigned texture() const { return colour_.name(); }
    [[nodiscard]] glm::ivec2 sizePixels() const { return size_; }

  private:
    glm::ivec2 size_;
    Texture colour_;
    Framebuffer framebuffer_;
};

// Red, green and blue of every pixel, top row first, in the sample's range.
template <class Sample>  // std::uint8_t, std::uint16_t or float
[[nodiscard]] std::vector<Sample> readRgb(const Target& target);

}  // namespace aquarama::gl
