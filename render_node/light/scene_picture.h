// SPDX-License-Identifier: Apache-2.0
// What a channel is drawn on: multisampled light of the scene, then what water and lens do to the
// picture of it, then display light.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"
#include "render_node/reef/quality.h"

namespace aquarama::scene {

class ScenePicture {
  public:
    explicit ScenePicture(const Quality& quality);
    void begin(glm::ivec2 sizePixels);  // binds and clears; a new size is a new set of buffers
    // Resolves, softens, tones; the texture that holds the display light. Expects the frame's
    // uniform block of the view.
    unsigned finish();

  private:
    // Light and its depth; without samples of its own to read from.
    struct Layer {
        gl::Texture colour{static_cast<GLenum>(GL_TEXTURE_2D)};
        gl::Texture depth{static_cast<GLenum>(GL_TEXTURE_2D)};
        gl::Framebuffer target;
    };

    void allocate(glm::ivec2 sizePixels);
    void resolve() const;
    void pass(unsigned framebuffer, unsigned program) const;

    Quality quality_;
    glm::ivec2 size_{0};
    gl::ProgramHandle tone_;
    std::optional<gl::ProgramHandle> soften_;
    gl::VertexArray empty_;
    Layer drawn_, resolved_;  // resolved: only where several samples are drawn
    gl::Texture softenedColour_, display_;
    gl::Framebuffer softened_, toned_;
};

}  // namespace aquarama::scene
