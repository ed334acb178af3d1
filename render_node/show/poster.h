// SPDX-License-Identifier: Apache-2.0
// Draws a poster: the panorama of the whole wall, a whole number of times as fine. It is drawn
// directly, not composed of the channels' pictures, in tiles that fit into textures.
#pragma once

#include <string>
#include <vector>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/poster_plan.h"
#include "render_node/show/snapshot.h"

namespace aquarama::show {

// What a poster is made of.
struct PosterOptions {
    glm::ivec2 panoramaPixels{};  // of the rig
    int scale = 2;
    config::QualityTier quality = config::QualityTier::Low;
    // Side of a tile's texture at most, if the driver has no lower limit. At 2048 the buffers of a
    // tile take 420 MB in the finest tier.
    int mostTilePixels = 2048;
};

// The world of one frame. Each channel's part is seen through the channel's frustum; where channels
// overlap, they blend as on the wall. In stereo it is what the point between the eyes sees. Uses GL
// objects of the world: use it on the thread where their context is current.
class Poster {
  public:
    // The wall must outlive it.
    Poster(const wall::Wall& wall, const DrawnWorld& world, const PosterOptions& options);
    [[nodiscard]] glm::ivec2 sizePixels() const;
    // The light of so many rows from this one on, in the poster's width. Throws Error where the
    // margin of a tile does not fit into a texture.
    [[nodiscard]] Light rows(int first, int count) const;

  private:
    // Rows of the poster, from this one on.
    struct Band {
        int first = 0;
        Light light;
    };
    void add(const PosterChannel& channel, const scene::PixelArea& area, Band& band) const;
    void draw(const PosterChannel& channel, const PosterTile& tile, Band& band) const;

    DrawnWorld world_;
    PosterOptions options_;
    int mostTilePixels_;
    std::vector<PosterChannel> channels_;
};

// Writes it to a PNG file, band by band. Takes the light and codes of a band of 1024 rows (18 bytes
// a pixel: 300 MB where the poster is 16 000 pixels wide) and the compressed file, beside the
// buffers of a tile. Throws Error as Poster does, or where it cannot be written.
void writePoster(const std::string& path, const Poster& poster, PictureBits bits);

}  // namespace aquarama::show
