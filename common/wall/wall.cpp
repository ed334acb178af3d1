// SPDX-License-Identifier: Apache-2.0
#include "common/wall/wall.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/formats/vendors.h"

namespace aquarama::wall {

glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side) {
    const double half = rig.stereo.eyeSeparationMetres / 2;
    const double right = side == EyeSide::Between ? 0 : side == EyeSide::Left ? -half : half;
    return rig.sweetSpotMetres + glm::dvec3(right, 0, 0);
}

glm::vec2 firstEyeShare(config::StereoMode mode) {
    if (mode == config::StereoMode::SideBySide) return {0.5F, 1};
    if (mode == config::StereoMode::TopBottom) return {1, 0.5F};
    return {1, 1};
}

config::Stereo stereoOf(const config::Rig& rig, std::size_t channel) {
    assert(channel < rig.channels.size());
    const config::Display& display = rig.channels[channel].display;
    config::Stereo stereo = rig.stereo;
    stereo.mode = display.stereo.value_or(stereo.mode);
    stereo.swapEyes = display.swapEyes.value_or(stereo.swapEyes);
    return stereo;
}

Wall::Wall(const config::Rig& rig)
    : rig_(rig),
      screen_(makeSurface(rig_)),
      adjustments_(config::adjustmentsOf(rig_)),
      blend_(adjustments_) {
    const WallFiles files = readWallFiles(rig_);
    for (const auto& [name, file] : files) formats::sayRemarks(file.remarks);
    for (std::size_t i = 0; i < rig_.channels.size(); ++i)
        channels_.push_back(
            adjusted(makeOptics(rig_, i, *screen_, files), rig_, i, *screen_, adjustments_));
}

Wall::~Wall() = default;

double pullAt(glm::dvec2 pixel, glm::ivec2 sizePixels) {
    const glm::dvec2 t = pixel / glm::dvec2(sizePixels);
    const glm::dvec2 hill = 4.0 * t * (1.0 - t);
    return hill.x * hill.x * hill.y * hill.y;
}

// The weight of a channel at a point before the weights are divided by their sum; 0 where it does
// not light the point.
double Wall::pull(std::size_t channel, glm::dvec3 point) const {
    const auto pixel = channels_[channel]->pixelOf(point);
    if (!pixel) return 0;
    return pullAt(*pixel, rig_.channels[channel].sizePixels);
}

// The blend of a wall file: the mean of its colours, interpolated between the centres of pixels.
double Wall::ownWeight(std::size_t channel, glm::dvec2 pixel) const {
    const glm::ivec2 size = rig_.channels[channel].sizePixels;
    const std::vector<glm::vec3>& blend = channels_[channel]->blend();
    const glm::dvec2 centre = glm::clamp(pixel - 0.5, glm::dvec2(0), glm::dvec2(size - 1));
    const glm::ivec2 low = glm::min(glm::ivec2(centre), glm::max(size - 2, 0));
    const glm::dvec2 share = centre - glm::dvec2(low);
    const auto at = [&](glm::ivec2 pixelAt) {
        const glm::ivec2 inside = glm::min(pixelAt, size - 1);
        const glm::vec3& light = blend[static_cast<std::size_t>(inside.y * size.x + inside.x)];
        return static_cast<double>(light.x + light.y + light.z) / 3;
    };
    const double above = glm::mix(at(low), at(low + glm::ivec2(1, 0)), share.x);
    const double below = glm::mix(at(low + glm::ivec2(0, 1)), at(low + 1), share.x);
    return glm::mix(above, below, share.y);
}

// The weight before masks and limits of blends.
double Wall::weightBefore(std::size_t channel, glm::dvec3 point) const {
    const bool isPanel = rig_.channels[channel].panel.has_value();
    if (isPanel || !channels_[channel]->blend().empty()) {
        const auto pixel = channels_[channel]->pixelOf(point);
        return !pixel ? 0 : isPanel ? 1 : ownWeight(channel, *pixel);
    }
    const double own = pull(channel, point);
    if (own <= 0) return 0;
    double sum = own;
    for (std::size_t i = 0; i < channels_.size(); ++i)
        if (i != channel) sum += pull(i, point);
    return own / sum;
}

double Wall::weight(std::size_t channel, glm::dvec3 point) const {
    assert(channel < channels_.size());
    return blend_.isIdentity() ? weightBefore(channel, point) : adjustedWeight(channel, point);
}

double Wall::adjustedWeight(std::size_t channel, glm::dvec3 point) const {
    if (weightBefore(channel, point) <= 0) return 0;
    const glm::dvec2 panorama(rig_.panoramaPixels);
    const glm::dvec2 place = screen_->unrolled(point);
    std::vector<BlendPart> parts;
    for (std::size_t i = 0; i < channels_.size(); ++i)
        if (const double share = weightBefore(i, point); share > 0)
            parts.push_back({.channel = i, .share = share, .mask = maskAt(i, point)});
    const auto pulls = [&](std::size_t i, glm::dvec2 pixels) -> std::optional<double> {
        const auto there = screen_->at(pixels / panorama);
        return there ? std::optional(pull(i, *there)) : std::nullopt;
    };
    blend_.adjust(parts, place * panorama, pulls);
    return std::ranges::find(parts, channel, &BlendPart::channel)->share;
}

double Wall::maskAt(std::size_t channel, glm::dvec3 point) const {
    const auto pixel = channels_[channel]->pixelOf(point);
    return pixel ? blend_.mask(
                       channel, *pixel, screen_->unrolled(point) * glm::dvec2(rig_.panoramaPixels))
                 : 1;
}

bool Wall::isMasked(glm::dvec3 point) const {
    for (std::size_t i = 0; i < channels_.size(); ++i)
        if (maskAt(i, point) < 1) return true;
    return false;
}

namespace {

bool isGrey(const std::vector<glm::vec3>& light) {
    return std::ranges::all_of(light,
                               [](glm::vec3 one) { return one.x == one.y && one.y == one.z; });
}

}  // namespace

WarpMap Wall::warp(std::size_t channel) const {
    assert(channel < channels_.size());
    const glm::ivec2 size = rig_.channels[channel].sizePixels;
    const Optics& optics = *channels_[channel];
    const bool isPanel = rig_.channels[channel].panel.has_value();
    const bool hasBlend = !optics.blend().empty();
    const bool isWeight = hasBlend && isGrey(optics.blend());
    WarpMap map{.sizePixels = size, .pointAndWeight = {}, .black = optics.black()};
    if (!isWeight) map.blend = optics.blend();
    map.pointAndWeight.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const auto weightOf = [&](glm::dvec3 point) -> double {
        if (isWeight) return static_cast<double>(optics.blend()[map.pointAndWeight.size()].x);
        return isPanel || hasBlend ? 1 : weight(channel, point);
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto point = optics.pointOf({x + 0.5, y + 0.5}, kSpillMetres);
            map.pointAndWeight.push_back(point ? glm::vec4(*point, weightOf(*point))
                                               : glm::vec4(0));
        }
    if (!blend_.isIdentity()) adjustMasks(channel, map);
    return map;
}

// The data of a wall file for each pixel, after masks and limits of blends.
void Wall::adjustMasks(std::size_t channel, WarpMap& map) const {
    if (channels_[channel]->blend().empty() && map.black.empty()) return;
    for (std::size_t i = 0; i < map.pointAndWeight.size(); ++i) {
        glm::vec4& pixel = map.pointAndWeight[i];
        const glm::dvec3 point(pixel);
        if (pixel.w <= 0) continue;
        if (!map.black.empty()) map.black[i] *= static_cast<float>(maskAt(channel, point));
        const double before = weightBefore(channel, point);
        if (channels_[channel]->blend().empty() || before <= 0) continue;
        const auto factor = static_cast<float>(adjustedWeight(channel, point) / before);
        if (map.blend.empty())
            pixel.w = std::min(pixel.w * factor, 1.0F);
        else
            map.blend[i] = glm::min(map.blend[i] * factor, 1.0F);
    }
}

namespace {

// A camera at `eye` with these axes.
glm::dmat4 cameraAt(glm::dvec3 eye, const glm::dmat3& wallFromCamera) {
    return glm::translate(glm::dmat4(glm::transpose(wallFromCamera)), -eye);
}

// A camera that looks horizontally towards an azimuth (right positive): upright things stay upright
// in every channel.
glm::dmat3 levelAxes(double azimuth) {
    const glm::dvec3 right(std::cos(azimuth), 0, std::sin(azimuth));
    const glm::dvec3 back(-std::sin(azimuth), 0, std::cos(azimuth));
    return {right, glm::dvec3(0, 1, 0), back};
}

// A camera that looks along a direction, without roll.
glm::dmat3 aimedAxes(glm::dvec3 direction) {
    constexpr double kNearlyUp = 0.95;  // where "without roll" has no meaning any more
    const glm::dvec3 up =
        std::abs(direction.y) < kNearlyUp ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(direction, up));
    return {right, glm::cross(right, direction), -direction};
}

// The azimuth of the middle of the lit points, seen from between the eyes; nothing where they
// surround the back.
double azimuthOfMiddle(const std::vector<glm::dvec3>& lit, glm::dvec3 between) {
    const auto [leftmost, rightmost] =
        std::ranges::minmax(lit, {}, [&](glm::dvec3 point) { return azimuthOf(point - between); });
    return (azimuthOf(leftmost - between) + azimuthOf(rightmost - between)) / 2;
}

// A level camera where that wastes few pixels: where nothing is very high or low, or behind.
glm::dmat3 axesFor(const std::vector<glm::dvec3>& lit, glm::dvec3 between) {
    constexpr double kSteepest = 45 * kRadiansPerDegree<double>;
    glm::dvec3 sum(0);
    double steepest = 0;
    for (const glm::dvec3& point : lit) {
        sum += glm::normalize(point - between);
        steepest = std::max(steepest, std::abs(elevationOf(point - between)));
    }
    const bool isBehind = std::abs(azimuthOf(sum)) > std::numbers::pi / 2;
    if (steepest > kSteepest || isBehind) return aimedAxes(glm::normalize(sum));
    return levelAxes(azimuthOfMiddle(lit, between));
}

// The tangent of an angle that is larger by so much.
double widened(double tangent, double byRadians) {
    return std::tan(std::atan(tangent) + byRadians);
}

// Tangents.
struct Extents {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

Extents widened(const Extents& extents, double byRadians) {
    return {{widened(extents.low.x, -byRadians), widened(extents.low.y, -byRadians)},
            {widened(extents.high.x, byRadians), widened(extents.high.y, byRadians)}};
}

// The pixels of a panel that make a margin before (left, below) and after it.
struct PanelMargin {
    glm::dvec2 before{0}, after{0};
};

PanelMargin marginOf(const Extents& panel, double byRadians, glm::ivec2 sizePixels) {
    const glm::dvec2 pixel = (panel.high - panel.low) / glm::dvec2(sizePixels);
    const Extents least = widened(panel, byRadians);
    return {glm::ceil((panel.low - least.low) / pixel),
            glm::ceil((least.high - panel.high) / pixel)};
}

// The extents with a margin of whole pixels, so that each of the panel's is one of the picture's.
void takeMargin(ChannelFrustum& frustum,
                const Extents& panel,
                const PanelMargin& margin,
                glm::ivec2 sizePixels) {
    const glm::dvec2 pixel = (panel.high - panel.low) / glm::dvec2(sizePixels);
    const glm::dvec2 low = panel.low - margin.before * pixel;
    const glm::dvec2 high = panel.high + margin.after * pixel;
    frustum.left = low.x;
    frustum.bottom = low.y;
    frustum.right = high.x;
    frustum.top = high.y;
    frustum.sizePixels = sizePixels + glm::ivec2(margin.before + margin.after);
}

// Lit points must be this far in front of the eye.
constexpr double kLeastAheadMetres = 0.1;

}  // namespace

namespace {

// The extents of the lit points, seen by a camera. Throws Error, which names the channel, where a
// point is beside or behind the camera.
Extents extentsOf(const std::vector<glm::dvec3>& lit,
                  const glm::dmat4& cameraFromWall,
                  const std::string& channel) {
    Extents extents;
    for (const glm::dvec3& point : lit) {
        const glm::dvec4 seen = cameraFromWall * glm::dvec4(point, 1);
        if (-seen.z < kLeastAheadMetres)
            throw Error("channel \"" + channel +
                        "\" lights what is beside or behind the eyes; move sweet_spot back");
        const glm::dvec2 tangent = glm::dvec2(seen) / -seen.z;
        extents.low = glm::min(extents.low, tangent);
        extents.high = glm::max(extents.high, tangent);
    }
    return extents;
}

}  // namespace

ChannelFrustum Wall::frustum(std::size_t channel, double marginRadians, EyeSide eye) const {
    assert(channel < channels_.size());
    const config::Channel& what = rig_.channels[channel];
    const Optics& optics = *channels_[channel];
    const std::vector<glm::dvec3> lit = optics.outline(kSpillMetres);
    if (lit.empty()) throw Error("channel \"" + what.name + "\" misses the screen; aim it there");
    const auto panel = optics.wallFromPanel();
    const glm::dmat3 axes = panel ? *panel : axesFor(lit, rig_.sweetSpotMetres);
    ChannelFrustum frustum;
    frustum.cameraFromWall = cameraAt(eyePosition(rig_, eye), axes);
    const Extents extents = extentsOf(lit, frustum.cameraFromWall, what.name);
    if (panel) {
        PanelMargin margin;  // the same for all eyes, whose pictures have one size
        for (const EyeSide side : {EyeSide::Left, EyeSide::Between, EyeSide::Right}) {
            const Extents seen = extentsOf(lit, cameraAt(eyePosition(rig_, side), axes), what.name);
            const PanelMargin least = marginOf(seen, marginRadians, what.sizePixels);
            margin.before = glm::max(margin.before, least.before);
            margin.after = glm::max(margin.after, least.after);
        }
        takeMargin(frustum, extents, margin, what.sizePixels);
        return frustum;
    }
    const Extents wide = widened(extents, marginRadians);
    frustum.left = wide.low.x;
    frustum.bottom = wide.low.y;
    frustum.right = wide.high.x;
    frustum.top = wide.high.y;
    return frustum;
}

glm::mat4 clipFromCamera(const ChannelFrustum& f, float nearMetres) {
    assert(f.right > f.left);
    assert(f.top > f.bottom);
    assert(nearMetres > 0);
    const double width = f.right - f.left;
    const double height = f.top - f.bottom;
    glm::mat4 clip(0.0F);
    clip[0][0] = static_cast<float>(2 / width);
    clip[1][1] = static_cast<float>(2 / height);
    clip[2][0] = static_cast<float>((f.right + f.left) / width);
    clip[2][1] = static_cast<float>((f.top + f.bottom) / height);
    clip[2][3] = -1;
    // So depth is near / distance.
    clip[3][2] = nearMetres;
    return clip;
}

namespace {

// The least angle, seen from the wall's origin, between a pixel's point and those of its neighbours
// to the right and below; that of a half turn where it has none.
double pixelRadiansAt(const Optics& optics, glm::dvec2 pixel) {
    constexpr double kSame = 1e-6;  // of a wall file that is cut off at an edge
    double finest = std::numbers::pi;
    const auto here = optics.pointOf(pixel, 0);
    for (const glm::dvec2 step : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
        const auto next = optics.pointOf(pixel + step, 0);
        if (!here || !next) continue;
        const double angle = glm::length(glm::cross(glm::normalize(*here), glm::normalize(*next)));
        if (angle > kSame) finest = std::min(finest, angle);
    }
    return finest;
}

}  // namespace

// At a grid of places of each channel.
double Wall::finestPixelRadians() const {
    constexpr int kProbes = 5;  // along each side of a picture
    double finest = std::numbers::pi;
    for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
        const glm::dvec2 size(rig_.channels[channel].sizePixels);
        for (int i = 0; i < kProbes * kProbes; ++i) {
            const glm::dvec2 pixel =
                size * (glm::dvec2(i % kProbes, i / kProbes) + 0.5) / double{kProbes};
            finest = std::min(finest, pixelRadiansAt(*channels_[channel], pixel));
        }
    }
    return finest;
}

glm::dvec3 Wall::patternOrigin() const {
    const bool isFar = screen_->patternGround().kind == PatternGround::Kind::Far;
    return isFar ? rig_.sweetSpotMetres : glm::dvec3(0);
}

}  // namespace aquarama::wall
