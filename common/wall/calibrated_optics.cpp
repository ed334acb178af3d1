// SPDX-License-Identifier: Apache-2.0
// The optics of a channel whose warp is in a wall file.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "common/base/log.h"
#include "common/formats/mpcdi.h"
#include "common/formats/wall_file.h"
#include "common/wall/optics.h"

namespace aquarama::wall {

namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

// The direction of a place (0 to 1, top left corner at (0, 0)) of a frustum's picture.
glm::dvec3 directionIn(const formats::Frustum& frustum, glm::dvec2 place) {
    const glm::dvec3 low(std::tan(frustum.left), std::tan(frustum.down), -1);
    const glm::dvec3 high(std::tan(frustum.right), std::tan(frustum.up), -1);
    const glm::dvec3 camera = glm::mix(low, high, glm::dvec3(place.x, 1 - place.y, 0));
    return formats::worldFromCamera(frustum) * camera;
}

// The part of a map that is needed to read it: the texels of a map of 4K are another 100 MB.
std::optional<formats::Warp> samplesOf(const std::optional<formats::Warp>& warp) {
    if (!warp) return std::nullopt;
    return formats::Warp{.size = warp->size, .sampling = warp->sampling, .samples = warp->samples};
}

// Converts the samples of a file's warp to points of a screen.
class Meaning {
  public:
    Meaning(glm::dvec3 sweetSpot,
            formats::Profile profile,
            const formats::FileChannel& channel,
            const ScreenSurface& screen)
        : profile_(profile),
          frustum_(channel.frustum.value_or(formats::Frustum{})),
          warp_(samplesOf(channel.warp)),
          screen_(screen),
          eye_(sweetSpot) {
        if (profile != formats::Profile::Projector) return;
        lens_ = samplesOf(channel.distortion);
        if (channel.coordinateFrame) eye_ = channel.coordinateFrame->canonicalPosition();
    }

    // The point of the screen that a place of the picture (0 to 1) lights.
    [[nodiscard]] std::optional<glm::dvec3> pointAt(glm::dvec2 place, double spill) const {
        const glm::dvec3 sample = sampleAt(place);
        if (std::isnan(sample.x)) return std::nullopt;
        if (profile_ == formats::Profile::Screen) return sample;
        if (profile_ == formats::Profile::Content) return screen_.at(glm::dvec2(sample));
        return screen_.hit({eye_, directionIn(frustum_, glm::dvec2(sample))}, spill);
    }

  private:
    // The file's lens maps a projector's pixels into the picture of its frustum, to which the warp
    // belongs.
    [[nodiscard]] glm::dvec3 sampleAt(glm::dvec2 place) const {
        glm::dvec3 sample(place, 0);
        for (const auto* map : {&lens_, &warp_})
            if (*map) sample = formats::warpAt(**map, glm::dvec2(sample));
        return sample;
    }

    formats::Profile profile_;
    formats::Frustum frustum_;
    std::optional<formats::Warp> lens_, warp_;
    const ScreenSurface& screen_;
    glm::dvec3 eye_;
};

// Finds pixels by places of the panorama: cells of it list the blocks of pixels that reach them.
class PixelFinder {
  public:
    // places: of the corners of pixels, (size + 1) each way, row by row.
    PixelFinder(glm::ivec2 sizePixels, std::vector<glm::dvec2> places)
        : size_(sizePixels), places_(std::move(places)), cells_(kCells * kCells) {
        for (int y = 0; y < size_.y; y += kBlock)
            for (int x = 0; x < size_.x; x += kBlock) enter({x, y});
    }

    [[nodiscard]] std::optional<glm::dvec2> find(glm::dvec2 place) const {
        if (place.x < 0 || place.y < 0 || place.x > 1 || place.y > 1) return std::nullopt;
        for (const glm::ivec2 corner : cells_[cellOf(place)]) {
            const glm::ivec2 end = glm::min(corner + kBlock, size_);
            for (int y = corner.y; y < end.y; ++y)
                for (int x = corner.x; x < end.x; ++x)
                    if (const auto inside = within({x, y}, place))
                        return glm::dvec2(x, y) + *inside;
        }
        return std::nullopt;
    }

  private:
    static constexpr int kBlock = 16;
    static constexpr int kCells = 128;  // each way

    [[nodiscard]] const glm::dvec2& corner(glm::ivec2 at) const {
        return places_[static_cast<std::size_t>(at.y * (size_.x + 1) + at.x)];
    }
    [[nodiscard]] static std::size_t cellOf(glm::dvec2 place) {
        const glm::ivec2 cell = glm::clamp(glm::ivec2(place * double{kCells}), 0, kCells - 1);
        return static_cast<std::size_t>(cell.y * kCells + cell.x);
    }
    void enter(glm::ivec2 block) {
        glm::dvec2 low(2), high(-1);
        const glm::ivec2 end = glm::min(block + kBlock, size_);
        for (int y = block.y; y <= end.y; ++y)
            for (int x = block.x; x <= end.x; ++x) {
                const glm::dvec2 at = corner({x, y});
                if (std::isnan(at.x)) continue;
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
        if (low.x > high.x) return;
        const glm::ivec2 from = glm::clamp(glm::ivec2(low * double{kCells}), 0, kCells - 1);
        const glm::ivec2 to = glm::clamp(glm::ivec2(high * double{kCells}), 0, kCells - 1);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                cells_[static_cast<std::size_t>(y * kCells + x)].push_back(block);
    }
    // The place within a pixel, 0 to 1 each way, as the two triangles of its corners have it.
    [[nodiscard]] std::optional<glm::dvec2> within(glm::ivec2 pixel, glm::dvec2 place) const {
        const glm::dvec2 a = corner(pixel), b = corner(pixel + glm::ivec2(1, 0));
        const glm::dvec2 c = corner(pixel + glm::ivec2(0, 1)), d = corner(pixel + 1);
        constexpr double kMostOfPanorama = 0.5;  // more goes round its back
        if (std::max({std::abs(b.x - a.x), std::abs(c.x - a.x), std::abs(d.x - a.x)}) >
            kMostOfPanorama)
            return std::nullopt;
        if (const auto t = share(a, b - a, c - a, place)) return t;
        if (const auto t = share(d, c - d, b - d, place)) return 1.0 - *t;
        return std::nullopt;
    }
    // place = origin + x along + y across, where x, y and 1 - x - y are not negative.
    [[nodiscard]] static std::optional<glm::dvec2> share(glm::dvec2 origin,
                                                         glm::dvec2 along,
                                                         glm::dvec2 across,
                                                         glm::dvec2 place) {
        constexpr double kSlack = 1e-9;
        const double determinant = along.x * across.y - along.y * across.x;
        const glm::dvec2 from = (place - origin) / determinant;
        const double x = from.x * across.y - from.y * across.x;
        const double y = along.x * from.y - along.y * from.x;
        const bool isInside = x >= -kSlack && y >= -kSlack && x + y <= 1 + kSlack;
        return isInside ? std::optional(glm::dvec2(x, y)) : std::nullopt;
    }

    glm::ivec2 size_;
    std::vector<glm::dvec2> places_;
    std::vector<std::vector<glm::ivec2>> cells_;
};

// Linear light of a mask at a pixel's centre.
std::vector<glm::vec3> lightOf(const formats::Mask& mask, glm::ivec2 sizePixels) {
    const formats::MaskLight maskLight(mask);
    std::vector<glm::vec3> light;
    light.reserve(static_cast<std::size_t>(sizePixels.x) * static_cast<std::size_t>(sizePixels.y));
    for (int y = 0; y < sizePixels.y; ++y)
        for (int x = 0; x < sizePixels.x; ++x)
            light.push_back(maskLight.at(glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(sizePixels)));
    return light;
}

class CalibratedOptics final : public Optics {
  public:
    CalibratedOptics(glm::ivec2 sizePixels,
                     const glm::dvec3& sweetSpot,
                     formats::Profile profile,
                     const formats::FileChannel& channel,
                     const ScreenSurface& screen)
        : size_(sizePixels),
          meaning_(sweetSpot, profile, channel, screen),
          screen_(screen),
          finder_(sizePixels, placesOfCorners()),
          colour_(channel.colour) {
        if (channel.blend) blend_ = lightOf(*channel.blend, sizePixels);
        if (channel.black) black_ = lightOf(*channel.black, sizePixels);
    }

    [[nodiscard]] std::optional<glm::dvec3> pointOf(glm::dvec2 pixel, double spill) const override {
        return meaning_.pointAt(pixel / size_, spill);
    }
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const override {
        return finder_.find(screen_.unrolled(point));
    }
    // All lit points, not the border alone: the unlit part of a file may have any shape.
    [[nodiscard]] std::vector<glm::dvec3> outline(double spill) const override {
        std::vector<glm::dvec3> lit;
        for (double y = 0.5; y < size_.y; ++y)
            for (double x = 0.5; x < size_.x; ++x)
                if (const auto point = pointOf({x, y}, spill)) lit.push_back(*point);
        return lit;
    }
    [[nodiscard]] const std::vector<glm::vec3>& blend() const override { return blend_; }
    [[nodiscard]] const std::vector<glm::vec3>& black() const override { return black_; }
    [[nodiscard]] const formats::ChannelColour* colour() const override {
        return colour_ ? &*colour_ : nullptr;
    }

  private:
    // In the panorama, of the corners of all pixels.
    [[nodiscard]] std::vector<glm::dvec2> placesOfCorners() const {
        std::vector<glm::dvec2> places;
        for (int y = 0; y <= static_cast<int>(size_.y); ++y)
            for (int x = 0; x <= static_cast<int>(size_.x); ++x) {
                const auto point = pointOf({x, y}, kSpillMetres);
                places.push_back(point ? screen_.unrolled(*point) : glm::dvec2(kNowhere));
            }
        return places;
    }

    glm::dvec2 size_;
    Meaning meaning_;
    const ScreenSurface& screen_;
    PixelFinder finder_;
    std::vector<glm::vec3> blend_, black_;
    std::optional<formats::ChannelColour> colour_;
};

const formats::FileChannel& channelNamed(const formats::WallFile& file,
                                         const config::Channel& channel) {
    const config::WallFileRegion& wanted = *channel.wallFile;
    std::string names;
    for (const formats::FileChannel& one : file.channels) {
        if (one.name == wanted.region || file.channels.size() == 1) return one;
        names += (names.empty() ? "" : ", ") + one.name;
    }
    throw Error(wanted.file + ": has no region \"" + wanted.region + "\" for channel \"" +
                channel.name + "\", only " + names + "; name one by wall_file.region");
}

// Throws Error where the region lacks what its profile needs to light a screen.
void requireGeometry(const formats::FileChannel& region,
                     formats::Profile profile,
                     const std::string& source) {
    const bool needsFrustum =
        profile == formats::Profile::View || profile == formats::Profile::Projector;
    if (needsFrustum && !region.frustum)
        throw Error(
            source + ": region \"" + region.name +
            "\" has no frustum, so its warp says nothing of the screen; export it with one");
    if (!needsFrustum && !region.warp)
        throw Error(source + ": region \"" + region.name +
                    "\" has no warp; export it with its geometry");
}

}  // namespace

std::vector<std::optional<formats::ChannelColour>> coloursOf(const config::Rig& rig) {
    const WallFiles files = readWallFiles(rig);
    std::vector<std::optional<formats::ChannelColour>> colours;
    for (const config::Channel& channel : rig.channels)
        colours.push_back(channel.wallFile
                              ? channelNamed(files.at(channel.wallFile->file), channel).colour
                              : std::nullopt);
    return colours;
}

std::unique_ptr<const Optics> makeCalibratedOptics(const config::Rig& rig,
                                                   std::size_t channel,
                                                   const ScreenSurface& screen,
                                                   const formats::WallFile& file) {
    const config::Channel& what = rig.channels.at(channel);
    const formats::FileChannel& region = channelNamed(file, what);
    const std::string& source = what.wallFile->file;
    requireGeometry(region, file.profile, source);
    if (region.distortion && file.profile != formats::Profile::Projector)
        logWarning("{}: the distortionMap of region {} is not used: it is of profile sl alone",
                   source,
                   region.name);
    return std::make_unique<CalibratedOptics>(
        what.sizePixels, rig.sweetSpotMetres, file.profile, region, screen);
}

}  // namespace aquarama::wall
