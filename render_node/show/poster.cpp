// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/poster.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <string>
#include <utility>

#include <glm/common.hpp>

#include "common/base/files.h"
#include "common/base/log.h"
#include "render_node/gl/handle.h"
#include "render_node/quality/quality.h"

namespace aquarama::show {

namespace {

// Rows that are drawn before they are encoded, and the side of the areas that are tried as tiles.
constexpr int kBandRows = 1024;

// The largest side of a picture that the driver can draw into.
int mostPixelsOfDriver() {
    int texture = 0;
    std::array<int, 2> viewport{};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    return std::min({texture, viewport[0], viewport[1]});
}

// The two halves of an area of at least two pixels, cut across its longer side.
std::pair<scene::PixelArea, scene::PixelArea> halves(const scene::PixelArea& area) {
    const int axis = area.size.x >= area.size.y ? 0 : 1;
    scene::PixelArea one = area;
    scene::PixelArea other = area;
    one.size[axis] = area.size[axis] / 2;
    other.corner[axis] += one.size[axis];
    other.size[axis] -= one.size[axis];
    return {one, other};
}

}  // namespace

Poster::Poster(const wall::Wall& wall, const DrawnWorld& world, const PosterOptions& options)
    : world_{world},
      options_{options},
      mostTilePixels_{std::min(options.mostTilePixels, mostPixelsOfDriver())} {
    assert(options.scale > 0);
    const PosterSize size{.panoramaPixels = options.panoramaPixels,
                          .scale = options.scale,
                          .pictureShare = scene::qualityOf(options.quality).pictureShare};
    std::vector<PanoramaShare> shares = panoramaShares(wall, options.panoramaPixels);
    for (std::size_t i = 0; i < shares.size(); ++i)
        if (!shares[i].share.empty()) channels_.emplace_back(wall, i, std::move(shares[i]), size);
}

glm::ivec2 Poster::sizePixels() const {
    return options_.panoramaPixels * options_.scale;
}

Light Poster::rows(int first, int count) const {
    Band band{first, darkness({sizePixels().x, count})};
    for (const PosterChannel& channel : channels_) {
        const scene::PixelArea lit = channel.area();
        const int top = std::max(first, lit.corner.y);
        const int bottom = std::min(first + count, lit.corner.y + lit.size.y);
        for (int x = 0; x < lit.size.x && top < bottom; x += kBandRows)
            add(channel,
                {{lit.corner.x + x, top}, {std::min(kBandRows, lit.size.x - x), bottom - top}},
                band);
    }
    return std::move(band.light);
}

// Cuts the area in two until a tile's texture is small enough.
void Poster::add(const PosterChannel& channel, const scene::PixelArea& area, Band& band) const {
    const auto tile = channel.tile(area);
    if (!tile) return;
    if (std::max(tile->part.size.x, tile->part.size.y) <= mostTilePixels_)
        return draw(channel, *tile, band);
    if (std::max(area.size.x, area.size.y) < 2)
        throw Error("a tile of the panorama and its margin do not fit into " +
                    std::to_string(mostTilePixels_) + " pixels; take a smaller --scale");
    const auto [one, other] = halves(area);
    add(channel, one, band);
    add(channel, other, band);
}

void Poster::draw(const PosterChannel& channel, const PosterTile& tile, Band& band) const {
    const unsigned scene = world_.renderer.draw(
        {.clipFromCamera = wall::clipFromCamera(channel.frustum(), kNearMetres),
         .cameraFromWorld = cameraFromWorld(channel.frustum(), world_.eye),
         .sizePixels = channel.picturePixels(),
         .part = tile.part,
         .finer = static_cast<float>(options_.scale)});
    const gl::Target target(GL_RGBA16, tile.poster.size);
    const Projection projection(tile.map, 0);
    projection.draw({.sceneTexture = scene,
                     .framebuffer = target.framebuffer(),
                     .frame = {},
                     .encoding = Encoding::Plain,
                     .brightness = world_.brightness});
    const Light light = lightOf({tile.poster.size, 16, gl::readRgb<std::uint16_t>(target)});
    const glm::ivec2 corner = tile.poster.corner - glm::ivec2(0, band.first);
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 0; x < light.sizePixels.x; ++x)
            band.light.at(corner.x + x, corner.y + y) += light.at(x, y);
}

void writePoster(const std::string& path, const Poster& poster, PictureBits bits) {
    const int depth = bits == PictureBits::Deep16 ? 16 : 8;
    const glm::ivec2 size = poster.sizePixels();
    PngBands png(size, depth);
    for (int row = 0; row < size.y; row += kBandRows) {
        const int count = std::min(kBandRows, size.y - row);
        png.add(pictureOf(poster.rows(row, count), depth, 0, row));
        logInfo("{}: {} of {} rows", path, row + count, size.y);
    }
    writeWhole(path, png.finish());
}

}  // namespace aquarama::show
