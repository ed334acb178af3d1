// SPDX-License-Identifier: Apache-2.0
// The geometry of the whole wall: the viewer's eyes, and the warp, blend and frustum of each
// channel. Channels are indices into Rig::channels.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/config/adjustments.h"
#include "common/config/rig.h"
#include "common/wall/adjusted_blend.h"
#include "common/wall/optics.h"
#include "common/wall/surface.h"

namespace aquarama::wall {

// One of the viewer's eyes, or the place between them, for mono pictures.
enum class EyeSide : std::uint8_t { Between, Left, Right };

// Wall frame, metres. The viewer faces the middle of the screen in all channels: so neighbours,
// which have the same two eyes, agree in their overlap.
[[nodiscard]] glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side);

// The stereo settings of the rig, with what the channel's display sets differently.
[[nodiscard]] config::Stereo stereoOf(const config::Rig& rig, std::size_t channel);
// Of a picture that packs two eyes: the share of its width and height, from the upper left corner,
// that is the first eye's.
[[nodiscard]] glm::vec2 firstEyeShare(config::StereoMode mode);

// The warp of a channel: for each pixel, top row first, the point that it lights and its blend
// weight.
struct WarpMap {
    glm::ivec2 sizePixels{};
    // Wall frame, metres; all 0 where the ray misses the screen and its spill.
    std::vector<glm::vec4> pointAndWeight;
    // Of wall files, in linear light: a blend with colours, which replaces the weight (then one),
    // and the least light of each pixel. Empty, or one value for each pixel.
    std::vector<glm::vec3> blend = {}, black = {};
};

// An off-axis frustum from an eye that just encloses the area that the channel lights, with a
// margin. Both eyes and the place between them have one direction. Camera frame: x right, y up,
// looking along -Z. The extents are tangents, at distance one.
struct ChannelFrustum {
    glm::dmat4 cameraFromWall{1.0};
    double left = 0, right = 0, bottom = 0, top = 0;
    // Of a panel: the size of the picture whose pixels are the panel's, with the margin.
    std::optional<glm::ivec2> sizePixels = {};
};
// Reversed depth: 1 at the near plane, 0 at infinity; there is no far plane.
[[nodiscard]] glm::mat4 clipFromCamera(const ChannelFrustum& frustum, float nearMetres);

// The weight of a place in a channel's picture before weights are divided by their sum: 0 with
// slope 0 at its borders, 1 in its middle. Two neighbours cross over as t^2 / (t^2 + (1 - t)^2).
[[nodiscard]] double pullAt(glm::dvec2 pixel, glm::ivec2 sizePixels);

// A rig's geometry, set up once for many points. Immutable; for any thread.
class Wall {
  public:
    // Throws Error where a measured screen, a wall file or the adjustments cannot be used.
    explicit Wall(const config::Rig& rig);
    ~Wall();
    Wall(const Wall&) = delete;
    Wall& operator=(const Wall&) = delete;

    // The screen, what shows each channel, and how many channels there are.
    [[nodiscard]] const ScreenSurface& screen() const { return *screen_; }
    [[nodiscard]] const Optics& channel(std::size_t channel) const { return *channels_[channel]; }
    [[nodiscard]] std::size_t channels() const { return channels_.size(); }

    // The share of a channel in the light at a point of the screen: smooth, 0 at its picture's
    // border. In linear light the shares of all channels that reach the point sum to one. Panels
    // share nothing. The blend of a wall file replaces the share. Masks and limits move light from
    // one channel to another, and change the sum only where all are masked.
    [[nodiscard]] double weight(std::size_t channel, glm::dvec3 point) const;
    // Cost: each pixel is tested against all channels.
    [[nodiscard]] WarpMap warp(std::size_t channel) const;
    // Throws Error where the channel lights nothing, or a part beside or behind the eye.
    [[nodiscard]] ChannelFrustum frustum(std::size_t channel,
                                         double marginRadians,
                                         EyeSide eye = EyeSide::Between) const;
    // Whether a mask that was set by hand takes light from a channel there.
    [[nodiscard]] bool isMasked(glm::dvec3 point) const;
    [[nodiscard]] const config::Adjustments& adjustments() const { return adjustments_; }
    // The angle, seen from the wall's origin, of the finest pixel of any channel on the screen;
    // radians. Samples 5 x 5 pixels of each channel.
    [[nodiscard]] double finestPixelRadians() const;
    // From where test patterns are seen as lines of equal azimuth and elevation.
    [[nodiscard]] glm::dvec3 patternOrigin() const;

  private:
    [[nodiscard]] double pull(std::size_t channel, glm::dvec3 point) const;
    [[nodiscard]] double ownWeight(std::size_t channel, glm::dvec2 pixel) const;
    [[nodiscard]] double weightBefore(std::size_t channel, glm::dvec3 point) const;
    [[nodiscard]] double adjustedWeight(std::size_t channel, glm::dvec3 point) const;
    [[nodiscard]] double maskAt(std::size_t channel, glm::dvec3 point) const;
    void adjustMasks(std::size_t channel, WarpMap& map) const;

    config::Rig rig_;
    std::unique_ptr<const ScreenSurface> screen_;
    config::Adjustments adjustments_;
    std::vector<std::unique_ptr<const Optics>> channels_;
    AdjustedBlend blend_;
};

// A strip of this share of the screen's width or height may stay dark at each of its edges.
inline constexpr double kDarkBorder = 0.005;

// The share of the panorama's screen that no channel lights, without the border.
[[nodiscard]] double darkShare(const Wall& wall);

// Throws Error, naming the place in the file `source`, when a channel misses the screen or spreads
// too wide, a part of the screen stays dark (unless the screen or a channel is measured), or an eye
// is beside or behind what a channel lights, or a corner of the surface that a tracker of hands
// watches is behind the viewer.
void checkGeometry(const config::Rig& rig, const std::string& source);

}  // namespace aquarama::wall
