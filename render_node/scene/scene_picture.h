// SPDX-License-Identifier: Apache-2.0
// What a channel is drawn on: multisampled light of the scene, then display light.
#pragma once

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"

namespace aquarama {

class ScenePicture {
  public:
    explicit ScenePicture(int samples);
    void begin(glm::ivec2 sizePixels);  // binds and clears; a new size is a new set of buffers
    unsigned finish();                  // resolves, tones; the texture that holds the display light

  private:
    void allocate(glm::ivec2 sizePixels);

    int samples_;
    glm::ivec2 size_{0};
    gl::ProgramHandle tone_;
    gl::VertexArray empty_;
    gl::Framebuffer drawn_, resolved_, toned_;
    gl::Texture drawnColour_, drawnDepth_, resolvedColour_, display_;
};

}  // namespace aquarama
