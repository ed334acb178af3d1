// SPDX-License-Identifier: Apache-2.0
// Test patterns that lie on the screen, in the picture of a channel's frustum.
#pragma once

#include <glm/vec4.hpp>

#include "common/wall/wall.h"
#include "render_node/gl/handle.h"

namespace aquarama::project {

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

}  // namespace aquarama::project
