// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/scene_picture.h"

#include <algorithm>

#include "render_node/gl/program.h"
#include "render_node/scene/texture.h"

namespace aquarama {

namespace {

int supported(int samples) {
    int most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    return std::clamp(samples, 1, std::max(most, 1));
}

gl::Texture makeLayer(GLenum format, glm::ivec2 size, int samples) {
    if (samples == 1) return makeTexture(format, size, 1, Edge::Clamp);
    gl::Texture texture{static_cast<GLenum>(GL_TEXTURE_2D_MULTISAMPLE)};
    glTextureStorage2DMultisample(texture.name(), samples, format, size.x, size.y, GL_TRUE);
    return texture;
}

}  // namespace

ScenePicture::ScenePicture(int samples)
    : samples_{supported(samples)},
      tone_{gl::makeProgram({"quad.vert", "tone.frag"})},
      drawnColour_{static_cast<GLenum>(GL_TEXTURE_2D)},
      drawnDepth_{static_cast<GLenum>(GL_TEXTURE_2D)},
      resolvedColour_{static_cast<GLenum>(GL_TEXTURE_2D)},
      display_{static_cast<GLenum>(GL_TEXTURE_2D)} {}

void ScenePicture::allocate(glm::ivec2 sizePixels) {
    size_ = sizePixels;
    drawnColour_ = makeLayer(GL_RGBA16F, size_, samples_);
    drawnDepth_ = makeLayer(GL_DEPTH_COMPONENT32F, size_, samples_);
    display_ = makeTexture(GL_RGBA16F, size_, 1, Edge::Clamp);
    drawn_ = makeTarget(drawnColour_);
    glNamedFramebufferTexture(drawn_.name(), GL_DEPTH_ATTACHMENT, drawnDepth_.name(), 0);
    toned_ = makeTarget(display_);
    if (samples_ == 1) return;
    resolvedColour_ = makeTexture(GL_RGBA16F, size_, 1, Edge::Clamp);
    resolved_ = makeTarget(resolvedColour_);
}

void ScenePicture::begin(glm::ivec2 sizePixels) {
    if (sizePixels != size_) allocate(sizePixels);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    glViewport(0, 0, size_.x, size_.y);
    // Every pixel will be covered: only the depth needs a value. Far is 0.
    glDepthMask(GL_TRUE);
    glClearDepth(0.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
}

unsigned ScenePicture::finish() {
    glDisable(GL_DEPTH_TEST);
    if (samples_ > 1)
        glBlitNamedFramebuffer(drawn_.name(),
                               resolved_.name(),
                               0,
                               0,
                               size_.x,
                               size_.y,
                               0,
                               0,
                               size_.x,
                               size_.y,
                               GL_COLOR_BUFFER_BIT,
                               GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, toned_.name());
    glUseProgram(tone_.name());
    glBindTextureUnit(0, samples_ > 1 ? resolvedColour_.name() : drawnColour_.name());
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return display_.name();
}

}  // namespace aquarama
