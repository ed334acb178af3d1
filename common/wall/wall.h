// SPDX-License-Identifier: Apache-2.0
// The geometry of the whole wall: the eyes of the viewer, the warp and the blend of each channel,
// and the frustum that it draws. Channels are indices into Rig::channels.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "common/wall/pinhole.h"

namespace aquarama::wall {

// The place between the eyes, from where a mono picture is seen; or one of the eyes.
enum class EyeSide : std::uint8_t { Between, Left, Right };

// Wall frame, metres. The viewer faces the middle of the screen in all channels: so neighbours,
// which have the same two eyes, agree in their overlap.
[[nodiscard]] glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side);

// The stereo settings of the rig, with what the channel's display sets differently.
[[nodiscard]] config::Stereo stereoOf(const config::Rig& rig, std::size_t channel);

// From projector pixel to screen point, and the blend between neighbours: analytic, for a cylinder.

// Where a projector's pixel (continuous, top left corner of the picture is (0, 0), texel centres at
// +0.5) lights the screen, wall frame; nothing where its ray misses the screen.
[[nodiscard]] std::optional<glm::dvec3> screenPoint(const config::Screen& screen,
                                                    const config::Channel& channel,
                                                    glm::dvec2 pixel);
// The inverse of screenPoint(); nothing where the point is outside of the picture or behind the
// projector.
[[nodiscard]] std::optional<glm::dvec2> projectorPixel(const config::Channel& channel,
                                                       glm::dvec3 screenPointMetres);

// The unrolled screen: u from its left edge (0) to its right (1), v from its top (0) to its bottom
// (1).
[[nodiscard]] glm::dvec2 unrolled(const config::Screen& screen, glm::dvec3 screenPointMetres);
// The inverse of unrolled().
[[nodiscard]] glm::dvec3 screenPointAt(const config::Screen& screen, glm::dvec2 unrolledPosition);

// The share of the light at a screen point that a channel gives: smooth, 0 at its picture's border.
// The shares of all channels that reach the point sum to one in linear light. For many points, use
// a Blend.
[[nodiscard]] double blendWeight(const config::Rig& rig,
                                 std::size_t channel,
                                 glm::dvec3 screenPointMetres);

// Light is drawn this far beyond the edges of the screen, a few pixels, where the frame of the
// screen cuts it off. Without it, pixels whose centres lie just past an edge would leave a dark
// line along it.
inline constexpr double kSpillMetres = 0.015;

// The warp of a channel: for each projector pixel, top row first, the point that it lights and its
// blend weight.
struct WarpMap {
    glm::ivec2 sizePixels{};
    // Wall frame, metres; all 0 where the ray misses the screen and its spill.
    std::vector<glm::vec4> pointAndWeight;
};
// Cost: each pixel is tested against all projectors.
[[nodiscard]] WarpMap warpMap(const config::Rig& rig, std::size_t channel);

// An off-axis frustum from an eye that just holds what the channel lights, enlarged by
// `marginRadians`. Both eyes and the place between them look the same way. Camera frame: x right, y
// up, looking along -Z. The extents are tangents, at distance one.
struct ChannelFrustum {
    glm::dmat4 cameraFromWall{1.0};
    double left = 0, right = 0, bottom = 0, top = 0;
};
// The channel must light some of the screen (checkGeometry()). Throws Error where it lights
// something beside or behind the eye.
[[nodiscard]] ChannelFrustum channelFrustum(const config::Rig& rig,
                                            std::size_t channel,
                                            double marginRadians,
                                            EyeSide eye = EyeSide::Between);
// Reversed depth: 1 at the near plane, 0 at infinity; there is no far plane.
[[nodiscard]] glm::mat4 clipFromCamera(const ChannelFrustum& frustum, float nearMetres);

// The angle, seen from the wall's origin, of the finest pixel that any channel throws on the
// screen; radians. Samples 5 x 5 pixels of each channel.
[[nodiscard]] double finestPixelRadians(const config::Rig& rig);

// A strip of this share of the screen's width or height may stay dark at each of its edges.
inline constexpr double kDarkBorder = 0.005;

// Throws Error, naming the place in the file `source`, when a projector misses the screen or
// spreads too wide, a part of the screen stays dark, or an eye is beside or behind what a channel
// lights.
void checkGeometry(const config::Rig& rig, const std::string& source);

// The blend of a whole rig for many points: blendWeight() with the projectors set up once.
// Immutable.
class Blend {
  public:
    explicit Blend(const config::Rig& rig);
    [[nodiscard]] double weight(std::size_t channel, glm::dvec3 screenPointMetres) const;
    [[nodiscard]] const Pinhole& projector(std::size_t channel) const {
        return projectors_[channel];
    }

  private:
    std::vector<Pinhole> projectors_;
};

}  // namespace aquarama::wall
