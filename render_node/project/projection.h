// SPDX-License-Identifier: Apache-2.0
// The last pass of a channel: scene picture to projector pixels, blended and encoded.
#pragma once

#include <cstdint>

#include "common/config/rig.h"
#include "common/units/ids.h"
#include "render_node/gl/handle.h"
#include "render_node/project/projection_map.h"

namespace aquarama::project {

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

}  // namespace aquarama::project
