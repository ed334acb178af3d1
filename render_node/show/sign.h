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

// Owns its GL objects; construct, use and destroy with the same context current.
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

}  // namespace aquarama::show
