// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/poster_plan.h"

#include <algorithm>
#include <cassert>
#include <thread>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/worker_pool.h"
#include "render_node/scene/scene_picture.h"
#include "render_node/show/channel_picture.h"

namespace aquarama::show {

namespace {

std::size_t index(glm::ivec2 at, int width) {
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(at.x);
}

std::size_t pixelsOf(glm::ivec2 size) {
    return index({0, size.y}, size.x);
}

// The weights of all channels at a pixel, divided by their sum: masks and wall files need not give
// a sum of one.
void weigh(const wall::Wall& wall,
           glm::ivec2 panoramaPixels,
           glm::ivec2 pixel,
           std::vector<std::vector<float>>& shares) {
    const auto point = wall.screen().at((glm::dvec2(pixel) + 0.5) / glm::dvec2(panoramaPixels));
    if (!point) return;
    const std::size_t place = index(pixel, panoramaPixels.x);
    float sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i)
        sum += shares[i][place] = static_cast<float>(wall.weight(i, *point));
    if (sum <= 0) return;
    for (std::vector<float>& share : shares) share[place] /= sum;
}

// The rectangle outside of which there is no share.
scene::PixelArea litArea(const std::vector<float>& share, glm::ivec2 panoramaPixels) {
    glm::ivec2 low = panoramaPixels;
    glm::ivec2 high(0);
    for (int y = 0; y < panoramaPixels.y; ++y)
        for (int x = 0; x < panoramaPixels.x; ++x) {
            if (share[index({x, y}, panoramaPixels.x)] <= 0) continue;
            low = glm::min(low, glm::ivec2(x, y));
            high = glm::max(high, glm::ivec2(x, y) + 1);
        }
    return {low, glm::max(high - low, 0)};
}

PanoramaShare cropped(const std::vector<float>& share, glm::ivec2 panoramaPixels) {
    PanoramaShare crop{litArea(share, panoramaPixels), {}};
    crop.share.reserve(pixelsOf(crop.area.size));
    for (int y = 0; y < crop.area.size.y; ++y) {
        const auto* row = &share[index(crop.area.corner + glm::ivec2(0, y), panoramaPixels.x)];
        crop.share.insert(crop.share.end(), row, row + crop.area.size.x);
    }
    return crop;
}

// The pixels of the whole picture that a map reads, as low and high corners; high is below low
// where it reads none.
std::pair<glm::dvec2, glm::dvec2> read(const ProjectionMap& map, glm::dvec2 picturePixels) {
    glm::dvec2 low(picturePixels);
    glm::dvec2 high(-1);
    for (const glm::vec4& place : map.placeAndWeight) {
        if (place.z <= 0) continue;
        const glm::dvec2 pixel = glm::dvec2(place) * picturePixels;
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    return {low, high};
}

}  // namespace

// Beyond the centres of the outer pixels the outer value goes on, so that the border of the screen
// stays lit.
float PanoramaShare::at(glm::dvec2 place) const {
    const glm::dvec2 own = place - glm::dvec2(area.corner);
    if (own.x < 0 || own.y < 0 || own.x >= area.size.x || own.y >= area.size.y) return 0;
    const glm::dvec2 at = glm::clamp(own - 0.5, glm::dvec2(0), glm::dvec2(area.size - 1));
    const glm::ivec2 low(at);
    const glm::ivec2 high = glm::min(low + 1, area.size - 1);
    const glm::vec2 t(at - glm::dvec2(low));
    const auto value = [&](int x, int y) { return share[index({x, y}, area.size.x)]; };
    return glm::mix(glm::mix(value(low.x, low.y), value(high.x, low.y), t.x),
                    glm::mix(value(low.x, high.y), value(high.x, high.y), t.x),
                    t.y);
}

std::vector<PanoramaShare> panoramaShares(const wall::Wall& wall, glm::ivec2 panoramaPixels) {
    std::vector<std::vector<float>> shares(wall.channels(),
                                           std::vector<float>(pixelsOf(panoramaPixels), 0.0F));
    WorkerPool(std::thread::hardware_concurrency())
        .run(static_cast<std::size_t>(panoramaPixels.y), [&](std::size_t y) {
            for (int x = 0; x < panoramaPixels.x; ++x)
                weigh(wall, panoramaPixels, {x, static_cast<int>(y)}, shares);
        });
    std::vector<PanoramaShare> crops;
    for (std::vector<float>& share : shares) {
        crops.push_back(cropped(share, panoramaPixels));
        share = {};
    }
    return crops;
}

PosterChannel::PosterChannel(const wall::Wall& wall,
                             std::size_t channel,
                             PanoramaShare share,
                             const PosterSize& size)
    : screen_{wall.screen()},
      share_{std::move(share)},
      size_{size},
      frustum_{wall.frustum(channel, kMarginRadians)} {
    assert(!share_.share.empty());
    const glm::ivec2 unscaled = scenePictureSize(map(share_.area, 1));
    picturePixels_ = glm::ceil(glm::vec2(unscaled * size.scale) * size.pictureShare);
}

scene::PixelArea PosterChannel::area() const {
    return {share_.area.corner * size_.scale, share_.area.size * size_.scale};
}

// place: in pixels of the panorama.
glm::vec4 PosterChannel::pointAndShare(glm::dvec2 place) const {
    const float share = share_.at(place);
    if (share <= 0) return glm::vec4(0);
    const auto point = screen_.at(place / glm::dvec2(size_.panoramaPixels));
    return point ? glm::vec4(*point, share) : glm::vec4(0);
}

// Of the panorama at a scale, in the whole picture of the frustum.
ProjectionMap PosterChannel::map(const scene::PixelArea& area, int scale) const {
    wall::WarpMap warp{.sizePixels = area.size, .pointAndWeight = {}};
    warp.pointAndWeight.reserve(pixelsOf(area.size));
    for (int y = 0; y < area.size.y; ++y)
        for (int x = 0; x < area.size.x; ++x) {
            const glm::dvec2 pixel = glm::dvec2(area.corner + glm::ivec2(x, y)) + 0.5;
            warp.pointAndWeight.push_back(pointAndShare(pixel / double(scale)));
        }
    return projectionMap(warp, frustum_);
}

// Along each axis; a radian has the more pixels the further they are from the axis.
glm::dvec2 PosterChannel::marginPixels(glm::dvec2 low, glm::dvec2 high) const {
    const glm::dvec2 corner(frustum_.left, frustum_.bottom);
    const glm::dvec2 extent(frustum_.right - frustum_.left, frustum_.top - frustum_.bottom);
    const glm::dvec2 pixels(picturePixels_);
    const glm::dvec2 most = glm::max(glm::abs(corner + extent * low / pixels),
                                     glm::abs(corner + extent * high / pixels));
    return kMarginRadians * (1 + glm::dot(most, most)) * pixels / extent;
}

std::optional<PosterTile> PosterChannel::tile(const scene::PixelArea& area) const {
    constexpr int kGrid = scene::ScenePicture::kPartPixels;
    PosterTile tile{.poster = area, .part = {}, .map = map(area, size_.scale)};
    const auto [low, high] = read(tile.map, glm::dvec2(picturePixels_));
    if (high.x < low.x) return std::nullopt;
    const glm::dvec2 margin = marginPixels(low, high);
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(low - margin)), 0) / kGrid * kGrid;
    const glm::ivec2 reach(glm::ceil(high + margin));
    const glm::ivec2 end = glm::min((reach + kGrid - 1) / kGrid * kGrid, picturePixels_);
    tile.part = {first, end - first};
    for (glm::vec4& place : tile.map.placeAndWeight) {
        const glm::dvec2 pixel =
            glm::dvec2(place) * glm::dvec2(picturePixels_) - glm::dvec2(tile.part.corner);
        const glm::vec2 own(pixel / glm::dvec2(tile.part.size));
        place = {own, place.z, place.w};
    }
    return tile;
}

}  // namespace aquarama::show
