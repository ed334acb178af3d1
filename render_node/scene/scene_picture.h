// SPDX-License-Identifier: Apache-2.0
// The buffers that a channel is drawn into, and the passes over the picture: multisampled light of
// the scene, scattering and bloom, then display light.
#pragma once

#include <optional>
#include <utility>

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
    // A pass over the picture: what it makes.
    struct Pass {
        explicit Pass(gl::ProgramHandle of) : program{std::move(of)} {}
        void resize(glm::ivec2 sizePixels, int levels);

        gl::ProgramHandle program;
        gl::Texture light{static_cast<GLenum>(GL_TEXTURE_2D)};  // RGBA16F
        gl::Framebuffer target;
    };

    // Makes the buffers that this quality needs.
    void allocate(glm::ivec2 sizePixels);
    // Makes light of one sample a pixel, with its depth in the fourth channel.
    void resolve() const;
    // The program that softens; that with more taps is made when it is first needed.
    [[nodiscard]] unsigned softening(bool isFiner);
    // Makes the glow about what is bright in a texture of light, and binds it for the tone.
    void spreadLight(unsigned light) const;
    // Draws one triangle that covers the picture of the pass, which a program reads at kSceneUnit.
    void draw(const Pass& pass, unsigned program, unsigned light) const;

    Quality quality_;
    glm::ivec2 size_{0};
    gl::VertexArray empty_;
    // What is drawn; a shader can filter it only where it has one sample a pixel.
    gl::Texture colour_{static_cast<GLenum>(GL_TEXTURE_2D)};
    gl::Texture depth_{static_cast<GLenum>(GL_TEXTURE_2D)};
    gl::Framebuffer drawn_;
    std::optional<Pass> resolve_, soften_, glow_;
    std::optional<gl::ProgramHandle> softenFiner_;
    Pass tone_;
};

}  // namespace aquarama::scene
