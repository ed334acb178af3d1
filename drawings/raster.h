// SPDX-License-Identifier: Apache-2.0
// Masks of triangles, and the lines around what they cover.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace aquarama::drawings {

// Which pixels belong to a shape. Row by row, y down.
class Raster {
  public:
    explicit Raster(glm::ivec2 sizePixels)
        : size_{sizePixels},
          inside_(static_cast<std::size_t>(sizePixels.x) * static_cast<std::size_t>(sizePixels.y)) {
    }
    // Width and height.
    [[nodiscard]] glm::ivec2 sizePixels() const { return size_; }
    // False outside of the raster.
    [[nodiscard]] bool at(int x, int y) const {
        return x >= 0 && y >= 0 && x < size_.x && y < size_.y && inside_[index(x, y)] != 0;
    }
    // Adds a pixel within the raster.
    void add(glm::ivec2 pixel) { inside_[index(pixel.x, pixel.y)] = 1; }
    // Adds the pixels whose centres (+0.5) are within the triangle, whichever way it turns.
    void add(const std::array<glm::vec2, 3>& corners);
    // Adds what another of the same size covers.
    void add(const Raster& other);
    // Whether all pixels within a distance, in pixels, belong to the shape.
    [[nodiscard]] bool isWithin(glm::vec2 at, int distance) const;

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(x);
    }
    glm::ivec2 size_;
    std::vector<std::uint8_t> inside_;
};

// A line through points; a closed one goes on from its last to its first.
using Polyline = std::vector<glm::vec2>;

// The closed lines around a shape, in pixels, smoothed over a few; islands and holes of less than
// `leastPixels` around are left out.
[[nodiscard]] std::vector<Polyline> contoursOf(const Raster& raster, std::size_t leastPixels);

}  // namespace aquarama::drawings
