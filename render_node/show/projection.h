// SPDX-License-Identifier: Apache-2.0
// For each pixel of a projector the place in its frustum's picture that it shows, computed once.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "common/config/rig.h"
#include "common/units/units.h"
#include "common/wall/wall.h"
#include "render_node/gl/handle.h"

namespace aquarama::show {

struct ProjectionMap {
    glm::ivec2 sizePixels{};
    // Top row first: texture coordinate in the frustum's picture (origin at its bottom left),
    // blend weight, 0.
    std::vector<glm::vec4> placeAndWeight;
};

// The eye is the frustum's.
[[nodiscard]] ProjectionMap projectionMap(const wall::WarpMap& warp,
                                          const wall::ChannelFrustum& frustum);

// The size at which the frustum's picture is as fine as the projector's pixels are in the middle of
// its lit area. Away from there a flat picture of a concave screen only gets finer, as the tangent
// grows faster than the angle.
[[nodiscard]] glm::ivec2 scenePictureSize(const ProjectionMap& map);

// The last pass of a channel: scene picture to projector pixels, blended and encoded.

enum class Encoding : std::uint8_t {
    Dithered8,  // +-1 code of triangular noise, a function of pixel, channel and the frame's parity
    Plain       // what the target's bits hold, for 16-bit pictures
};

// Owns its GL objects; construct, use and destroy with the same context current.
class Projection {
  public:
    Projection(const ProjectionMap& map, std::uint32_t channelId);

    struct Draw {
        unsigned sceneTexture = 0;  // linear light, 1 the projector's full white
        unsigned framebuffer = 0;   // at least the channel's size; drawn from its bottom left
        Frame frame;
        Encoding encoding = Encoding::Dithered8;
        bool blendMask = false;  // white instead of the scene: only the blend is seen
    };
    void draw(const Draw& what) const;
    [[nodiscard]] unsigned mapTexture() const { return map_.name(); }

  private:
    glm::ivec2 size_;
    std::uint32_t channelId_;
    gl::ProgramHandle program_;
    gl::Texture map_;
    gl::Sampler bilinear_;
    gl::VertexArray noVertices_;
};

// Both eyes in one picture, for a display that parts them again (docs/stereo.md).
class PairProjection {
  public:
    // Any mode but mono and quad-buffer.
    PairProjection(glm::ivec2 sizePixels, std::uint32_t channelId, config::StereoMode mode);

    // The maps are those of the eyes' own projections.
    struct Eye {
        unsigned sceneTexture = 0, mapTexture = 0;
    };
    // `both.sceneTexture` is left unread.
    void draw(const Eye& left, const Eye& right, const Projection::Draw& both) const;

  private:
    glm::ivec2 size_;
    std::uint32_t channelId_;
    config::StereoMode mode_;
    gl::ProgramHandle program_;
    gl::Sampler bilinear_;
    gl::VertexArray noVertices_;
};

// In the picture of an eye, the pixel that is seen at a pixel (continuous, from the top left
// corner) of what the display takes.
[[nodiscard]] glm::vec2 pixelOfEye(config::StereoMode mode, glm::ivec2 sizePixels, glm::vec2 pixel);

// Test patterns that lie on the screen, in the picture of a channel's frustum.

// Owns its GL objects; construct, use and destroy with the same context current.
class PatternPass {
  public:
    PatternPass(const wall::ChannelFrustum& frustum, const config::Screen& screen);

    void drawGrid(unsigned framebuffer, glm::ivec2 sizePixels) const;
    void drawGrey(unsigned framebuffer, glm::ivec2 sizePixels) const;
    // Lays the grid's light over what is there.
    void addGrid(unsigned framebuffer, glm::ivec2 sizePixels) const;

  private:
    void draw(unsigned framebuffer, glm::ivec2 sizePixels, float greyLight) const;

    wall::ChannelFrustum frustum_;
    glm::vec4 eyeAndRadius_;  // wall frame
    gl::ProgramHandle program_;
    gl::VertexArray noVertices_;
};

}  // namespace aquarama::show
