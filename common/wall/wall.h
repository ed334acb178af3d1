// SPDX-License-Identifier: Apache-2.0
// The viewer's eyes before the wall, and how a channel shows a picture to each.
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

// Between the eyes, where a mono picture is seen from; or one of them.
enum class EyeSide : std::uint8_t { Between, Left, Right };

// Wall frame, metres. The viewer faces the screen's middle whatever the channel: neighbours, each
// with the same two eyes, then agree in their overlap.
[[nodiscard]] glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side);

// The rig's, unless the channel's display has its own.
[[nodiscard]] config::Stereo stereoOf(const config::Rig& rig, std::size_t channel);

// From projector pixel to screen point to view ray, and the blend between neighbours: analytic, for
// a cylinder.

// Where a projector's pixel (continuous, top left corner of the picture is (0, 0), texel centres at
// +0.5) lights the screen, wall frame; nothing where its ray misses the screen.
[[nodiscard]] std::optional<glm::dvec3> screenPoint(const config::Screen& screen,
                                                    const config::Channel& channel,
                                                    glm::dvec2 pixel);
// The other way round; nothing where the point is outside the picture or behind the projector.
[[nodiscard]] std::optional<glm::dvec2> projectorPixel(const config::Channel& channel,
                                                       glm::dvec3 screenPointMetres);

// The unrolled screen: u from its left edge (0) to its right (1), v from its top (0) to its bottom
// (1).
[[nodiscard]] glm::dvec2 unrolled(const config::Screen& screen, glm::dvec3 screenPointMetres);
[[nodiscard]] glm::dvec3 screenPointAt(const config::Screen& screen, glm::dvec2 unrolledPosition);

// The share of the light at a screen point that a channel gives: smooth, 0 at its picture's border,
// and the shares of all channels that reach the point sum to one in linear light.
[[nodiscard]] double blendWeight(const config::Rig& rig,
                                 std::size_t channel,
                                 glm::dvec3 screenPointMetres);

// Light runs over the screen's edges by this much, a few pixels, and is cut off by its frame:
// otherwise the pixels whose centres lie just past an edge would leave a dark line along it.
inline constexpr double kSpillMetres = 0.015;

// The canonical warp of a channel: for each projector pixel, top row first, the point that it
// lights and its blend weight.
struct WarpMap {
    glm::ivec2 sizePixels{};
    std::vector<glm::vec4>
        pointAndWeight;  // wall frame, metres; 0 where the ray passes the screen and its spill
};
[[nodiscard]] WarpMap warpMap(const config::Rig& rig, std::size_t channel);

// An off-axis frustum from an eye that just holds what the channel lights, enlarged by
// `marginRadians`. Both eyes and the place between them look the same way. Camera frame: x right, y
// up, looking along -Z; extents are tangents at distance one.
struct ChannelFrustum {
    glm::dmat4 cameraFromWall{1.0};
    double left = 0, right = 0, bottom = 0, top = 0;
};
// Throws Error where the channel lights something beside or behind the eye.
[[nodiscard]] ChannelFrustum channelFrustum(const config::Rig& rig,
                                            std::size_t channel,
                                            double marginRadians,
                                            EyeSide eye = EyeSide::Between);
// Reversed depth, zero to one, infinite far plane.
[[nodiscard]] glm::mat4 clipFromCamera(const ChannelFrustum& frustum, float nearMetres);

// The angle at the sweet spot of the finest pixel that any channel throws on the screen, radians.
[[nodiscard]] double finestPixelRadians(const config::Rig& rig);

// This share of the screen's width and height may stay dark at each of its edges.
inline constexpr double kDarkBorder = 0.005;

// Throws Error (with `source`) when a projector misses the screen, the screen is not covered, or
// neighbours leave a gap.
void checkGeometry(const config::Rig& rig, const std::string& source);

// The blend of a whole rig made ready for many points: what blendWeight of wall.h computes.

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
