// SPDX-License-Identifier: Apache-2.0
// What a poster needs to know before it is drawn: which channel shows which of its pixels, and how
// each is cut into tiles. A poster is the panorama, a whole number of times as fine.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/rig.h"
#include "common/wall/wall.h"
#include "render_node/scene/scene.h"
#include "render_node/show/projection.h"

namespace aquarama::show {

// The share of a channel in the light of the panorama: of its unscaled pixels within `area`, row by
// row, corners and rows from the top left. The shares of all channels sum to one wherever there is
// light.
struct PanoramaShare {
    scene::PixelArea area;
    std::vector<float> share;

    // Bilinear, at a place in pixels of the panorama; 0 outside of the area.
    [[nodiscard]] float at(glm::dvec2 place) const;
};

// For each channel of the wall. Uses all processors.
[[nodiscard]] std::vector<PanoramaShare> panoramaShares(const wall::Wall& wall,
                                                        glm::ivec2 panoramaPixels);

// A tile: pixels of the poster, the part of the channel's picture that they show, and where in that
// part each is.
struct PosterTile {
    scene::PixelArea poster;  // from the top left
    scene::PixelArea part;    // from the lower left corner of the channel's picture
    ProjectionMap map;
};

// The size of a poster.
struct PosterSize {
    glm::ivec2 panoramaPixels{};  // of the rig
    int scale = 1;
    // Pixels of the scene's picture relative to those of the poster, along either axis.
    float pictureShare = 1.0F;
};

// A channel's part of a poster. Immutable; the wall must outlive it.
class PosterChannel {
  public:
    // The share must not be empty.
    PosterChannel(const wall::Wall& wall,
                  std::size_t channel,
                  PanoramaShare share,
                  const PosterSize& size);
    // Its frustum, from between the eyes, and the size of the whole picture of it.
    [[nodiscard]] const wall::ChannelFrustum& frustum() const { return frustum_; }
    [[nodiscard]] glm::ivec2 picturePixels() const { return picturePixels_; }
    // The pixels of the poster that it lights, from the top left.
    [[nodiscard]] scene::PixelArea area() const;
    // Empty where it lights none of these pixels of the poster. The part has the margin that
    // softening and bloom need; it may be larger than a texture can be.
    [[nodiscard]] std::optional<PosterTile> tile(const scene::PixelArea& area) const;

  private:
    [[nodiscard]] ProjectionMap map(const scene::PixelArea& area, int scale) const;
    [[nodiscard]] glm::vec4 pointAndShare(glm::dvec2 place) const;
    [[nodiscard]] glm::dvec2 marginPixels(glm::dvec2 low, glm::dvec2 high) const;

    const wall::ScreenSurface& screen_;
    PanoramaShare share_;
    PosterSize size_;
    wall::ChannelFrustum frustum_;
    glm::ivec2 picturePixels_{};
};

}  // namespace aquarama::show
