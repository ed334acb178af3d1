// SPDX-License-Identifier: Apache-2.0
// The buffers that a channel is drawn into, and the passes over the picture: multisampled light of
// the scene, scattering and bloom, then display light.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"
#include "render_node/quality/quality.h"

namespace aquarama::scene {

// One picture: begin(), draw, finish(). Owns its GL objects; construct, use and destroy it with the
// same context current.
class ScenePicture {
  public:
    // Where the corner of a part of a picture is a multiple of so many pixels, its mip levels,
    // which bloom reads, are those of the whole.
    static constexpr int kPartPixels = 128;

    explicit ScenePicture(const Quality& quality);
    // Binds and clears the buffers; a new size allocates new ones.
    void begin(glm::ivec2 sizePixels);
    // Resolves the samples, softens, adds bloom and tones. Returns the GL name of the texture that
    // holds the display light (RGBA16F), valid until the next picture. Expects the frame's uniform
    // block of the view to be bound. isFiner: its pixels are finer than the wall's, and softening
    // takes more of them.
    unsigned finish(bool isFiner);

  private:
    // Light and depth of one layer. A multisampled layer is only drawn into; shaders read a layer
    // that has one sample.
    struct Layer {
        gl::Texture colour{static_cast<GLenum>(GL_TEXTURE_2D)};
        gl::Texture depth{static_cast<GLenum>(GL_TEXTURE_2D)};
        gl::Framebuffer target;
    };

    // Makes the buffers of the layers that this quality needs.
    void allocate(glm::ivec2 sizePixels);
    void resolve() const;
    // The program that softens; that with more taps is made when it is first needed.
    [[nodiscard]] unsigned softening(bool isFiner);
    // Draws one triangle that covers the picture.
    void pass(unsigned framebuffer, unsigned program) const;

    Quality quality_;
    glm::ivec2 size_{0};
    gl::ProgramHandle tone_;
    std::optional<gl::ProgramHandle> soften_, softenFiner_;
    gl::VertexArray empty_;
    // resolved_ is empty where drawn_ has one sample.
    Layer drawn_, resolved_;
    gl::Texture softenedColour_, display_;
    gl::Framebuffer softened_, toned_;
};

}  // namespace aquarama::scene
