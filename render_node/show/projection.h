// SPDX-License-Identifier: Apache-2.0
// From the picture of a frustum to the pixels of a projector: the map, the passes that apply it,
// and test patterns.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint4_sized.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/config/scan.h"
#include "common/formats/wall_file.h"
#include "common/wall/wall.h"
#include "render_node/gl/handle.h"

namespace aquarama::show {

// For each pixel of a projector the place in its frustum's picture that it shows. Computed once.
struct ProjectionMap {
    glm::ivec2 sizePixels{};
    // One entry for each pixel, top row first: texture coordinate in the frustum's picture (origin
    // at its bottom left), blend weight, 0. All 0 for a pixel that lights no part of the screen.
    std::vector<glm::vec4> placeAndWeight;
    // Blend and black level as in wall::WarpMap; of all pixels, or empty.
    std::vector<glm::vec3> blend = {}, black = {};
};

// Projects each screen point of the warp into the frustum's picture, for the frustum's eye.
[[nodiscard]] ProjectionMap projectionMap(const wall::WarpMap& warp,
                                          const wall::ChannelFrustum& frustum);

// The size, in pixels, at which the frustum's picture is as fine as the projector's pixels in the
// middle of its lit area. Elsewhere a flat picture of a concave screen is finer, as the tangent
// grows faster than the angle; where the middle lights nothing, near it. Throws Error: fewer than
// 2 x 2 pixels, or a picture that misses the screen.
[[nodiscard]] glm::ivec2 scenePictureSize(const ProjectionMap& map);

// The last pass of a channel: from the scene's picture to projector pixels, blended and encoded.

// How light becomes a code of the target.
enum class Encoding : std::uint8_t {
    Dithered8,  // +-1 code of triangular noise, a function of pixel, channel and the frame's parity
    Plain       // what the target's bits hold, for 16-bit pictures
};

// The codes that a projector takes for light, where its channel has a colour. Owns a GL object;
// construct, use and destroy with the same context current.
class ProjectorCodes {
  public:
    explicit ProjectorCodes(const formats::ChannelColour& colour);
    // Gives them to the pass whose program is in use.
    void use() const;

  private:
    glm::mat3 ownFromLight_;
    gl::Texture table_{GL_TEXTURE_1D};
};

// Owns its GL objects; construct, use and destroy with the same context current.
class Projection {
  public:
    Projection(const ProjectionMap& map, std::uint32_t channelId);

    // What one pass reads and writes.
    struct Draw {
        // GL name of the scene's picture: linear light, 1 is the projector's full white.
        unsigned sceneTexture = 0;
        // At least of the channel's size; drawn from its bottom left corner.
        unsigned framebuffer = 0;
        Frame frame;
        Encoding encoding = Encoding::Dithered8;
        // Draws white in place of the scene, so that only the blend is seen.
        bool blendMask = false;
        // Share of the light, 0 black to 1.
        float brightness = 1.0F;
        // Null: the projector takes sRGB.
        const ProjectorCodes* codes = nullptr;
    };
    void draw(const Draw& what) const;
    // Binds blend and black level of a wall file, where there are, for the program in use.
    void bindMasks() const;
    // GL name of the projection map, for PairProjection.
    [[nodiscard]] unsigned mapTexture() const { return map_.name(); }

  private:
    glm::ivec2 size_;
    std::uint32_t channelId_;
    gl::ProgramHandle program_;
    gl::Texture map_;
    std::optional<gl::Texture> blend_, black_;
    gl::Sampler bilinear_;
    gl::VertexArray noVertices_;
};

// Combines both eyes in one picture, for a display that separates them again (docs/stereo.md). Owns
// its GL objects, as Projection.
class PairProjection {
  public:
    // mode: any but mono and quad-buffer, which need no pair. Side by side needs an even width, top
    // and bottom an even height.
    PairProjection(glm::ivec2 sizePixels, std::uint32_t channelId, config::StereoMode mode);

    // GL name of the picture of one eye, and its projection. A wall file's masks are of the
    // display: those of the left eye are taken.
    struct Eye {
        unsigned sceneTexture = 0;
        const Projection& projection;
    };
    // Draws both pictures into both.framebuffer; both.sceneTexture is not read.
    void draw(const Eye& left, const Eye& right, const Projection::Draw& both) const;

  private:
    glm::ivec2 size_;
    std::uint32_t channelId_;
    config::StereoMode mode_;
    gl::ProgramHandle program_;
    gl::Sampler bilinear_;
    gl::VertexArray noVertices_;
};

// The pixel in the picture of one eye that is shown at a pixel of the display's picture; both
// continuous, from the top left corner.
[[nodiscard]] glm::vec2 pixelOfEye(config::StereoMode mode, glm::ivec2 sizePixels, glm::vec2 pixel);

// The patterns of a scan: the projector's own pixels, as wall::scanLight() has them, each colour
// rounded to a code of 8 bits.

// Codes for the channel of this index in the rig, top row first. A display that takes half a
// picture for each eye gets the pattern in both halves.
[[nodiscard]] std::vector<glm::u8vec4> scanCodes(const config::ScanPattern& pattern,
                                                 std::size_t channel,
                                                 glm::ivec2 sizePixels,
                                                 config::StereoMode mode);

// Owns its GL objects; construct, use and destroy with the same context current.
class ScanPass {
  public:
    ScanPass(glm::ivec2 sizePixels, std::size_t channel)
        : picture_{GL_RGBA8, sizePixels}, channel_{channel} {}

    // Into the framebuffer's bottom left corner. A pattern is computed when it is first drawn.
    void draw(unsigned framebuffer, const config::ScanPattern& pattern, config::StereoMode mode);

  private:
    gl::Target picture_;
    std::size_t channel_;
    std::optional<std::pair<config::ScanPattern, config::StereoMode>> drawn_;
};

// Test patterns that lie on the screen, drawn into the picture of a channel's frustum.

// Owns its GL objects; construct, use and destroy with the same context current.
class PatternPass {
  public:
    PatternPass(const wall::ChannelFrustum& frustum, const wall::PatternGround& ground);

    // Draws lines of equal azimuth and elevation, seen from Wall::patternOrigin().
    void drawGrid(unsigned framebuffer, glm::ivec2 sizePixels) const;
    // Draws an even grey of wall::kGreyLight.
    void drawGrey(unsigned framebuffer, glm::ivec2 sizePixels) const;
    // Adds the light of the grid to what is there.
    void addGrid(unsigned framebuffer, glm::ivec2 sizePixels) const;

  private:
    void draw(unsigned framebuffer, glm::ivec2 sizePixels, float greyLight) const;

    wall::ChannelFrustum frustum_;
    wall::PatternGround ground_;
    glm::vec4 eyeAndSize_;  // local frame of the ground, metres: the eye, and its size
    gl::ProgramHandle program_;
    gl::VertexArray noVertices_;
};

}  // namespace aquarama::show
