// SPDX-License-Identifier: Apache-2.0
// The sign for visitors in a corner of a channel's picture: where it stands, and the pass that
// draws it.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "common/config/rig.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/handle.h"
#include "render_node/show/projection.h"

namespace aquarama::show {

// Where a sign of this shape (width by height, in pixels of the scene's picture) stands: in the
// part of the picture that this channel alone lights, at full weight, as near to the corner as it
// can. Left, bottom, right and top, 0 to 1 from the picture's bottom left. Nothing: it fits
// nowhere. `pictureSize`: of the scene's picture. The map is read in blocks of 1/96 of the picture.
[[nodiscard]] std::optional<glm::vec4> signPlace(const ProjectionMap& map,
                                                 config::Guests::Corner corner,
                                                 double height,
                                                 double widthByHeight,
                                                 glm::ivec2 pictureSize);

// The pass that draws dots. Owns its GL objects; construct, use and destroy with the same context
// current.
class SignPass {
  public:
    SignPass();
    // Into the picture of linear light of this size, at a place that signPlace() found.
    void draw(unsigned framebuffer,
              glm::ivec2 sizePixels,
              const wire::Sign& sign,
              const glm::vec4& place) const;

  private:
    gl::ProgramHandle program_;
    gl::VertexArray noVertices_;
};

// The sign of a channel that draws it. As SignPass.
class ChannelSign {
  public:
    explicit ChannelSign(const config::Guests& guests) : guests_{guests} {}
    // Finds its place, where its shape is another than at the last call; warns where there is none.
    void place(const wire::Sign& sign, const ProjectionMap& map, glm::ivec2 pictureSize);
    // Into the picture of linear light of this size; a sign without dots, or place, is not drawn.
    void draw(unsigned framebuffer, glm::ivec2 sizePixels, const wire::Sign& sign) const;

  private:
    config::Guests guests_;
    SignPass pass_;
    glm::uvec2 size_{};  // columns and rows that the place is for
    std::optional<glm::vec4> place_;
};

}  // namespace aquarama::show
