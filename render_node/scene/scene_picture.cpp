// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/scene_picture.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "render_node/gl/program.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// Mip levels of the picture that bloom reads. The last is the one that the widest ring of
// bloom.glsl needs where a radian has 16 000 pixels.
constexpr int kBloomLevels = 8;
static_assert(1 << (kBloomLevels - 1) == ScenePicture::kPartPixels);

// The number of samples, limited to what the driver has; 1 to GL_MAX_SAMPLES.
int supported(int samples) {
    int most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    return std::clamp(samples, 1, std::max(most, 1));
}

// A texture for a layer: with several samples it has one level and cannot be filtered.
gl::Texture makeLayer(GLenum format, glm::ivec2 size, int samples, int levels = 1) {
    if (samples == 1) return makeTexture(format, size, levels, Edge::Clamp);
    gl::Texture texture{static_cast<GLenum>(GL_TEXTURE_2D_MULTISAMPLE)};
    glTextureStorage2DMultisample(texture.name(), samples, format, size.x, size.y, GL_TRUE);
    return texture;
}

// kBloomLevels, or fewer for a small picture.
int bloomLevels(glm::ivec2 size) {
    int levels = 1;
    while (levels < kBloomLevels && std::min(size.x, size.y) >> levels > 0) ++levels;
    return levels;
}

// Bloom is an include of the last pass, so that it costs no pass of its own.
gl::ProgramHandle makeTone(bool bloom) {
    if (!bloom) return gl::makeProgram({"quad.vert", "tone.frag"});
    return gl::makeProgram({"quad.vert", "tone.frag"}, {{"scene_light.glsl", "bloom.glsl"}});
}

}  // namespace

ScenePicture::ScenePicture(const Quality& quality)
    : quality_{quality},
      tone_{makeTone(quality.bloom)},
      softenedColour_{static_cast<GLenum>(GL_TEXTURE_2D)},
      display_{static_cast<GLenum>(GL_TEXTURE_2D)} {
    quality_.samples = supported(quality.samples);
    if (quality.softening) soften_.emplace(gl::makeProgram({"quad.vert", "soften.frag"}));
}

void ScenePicture::allocate(glm::ivec2 sizePixels) {
    size_ = sizePixels;
    const int levels = quality_.bloom ? bloomLevels(size_) : 1;
    const auto fill = [&](Layer& layer, int samples, int of) {
        layer.colour = makeLayer(GL_RGBA16F, size_, samples, of);
        layer.depth = makeLayer(GL_DEPTH_COMPONENT32F, size_, samples);
        layer.target = makeTarget(layer.colour);
        glNamedFramebufferTexture(layer.target.name(), GL_DEPTH_ATTACHMENT, layer.depth.name(), 0);
    };
    // Only the texture that the last pass reads has mip levels.
    const int unsoftened = soften_ ? 1 : levels;
    fill(drawn_, quality_.samples, unsoftened);
    if (quality_.samples > 1) fill(resolved_, 1, unsoftened);
    if (soften_) {
        softenedColour_ = makeTexture(GL_RGBA16F, size_, levels, Edge::Clamp);
        softened_ = makeTarget(softenedColour_);
    }
    display_ = makeTexture(GL_RGBA16F, size_, 1, Edge::Clamp);
    toned_ = makeTarget(display_);
}

void ScenePicture::begin(glm::ivec2 sizePixels) {
    assert(sizePixels.x > 0);
    assert(sizePixels.y > 0);
    if (sizePixels != size_) allocate(sizePixels);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.target.name());
    glViewport(0, 0, size_.x, size_.y);
    // Every pixel will be covered: only the depth needs a value. Far is 0.
    glDepthMask(GL_TRUE);
    glClearDepth(0.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
}

// The resolved colour is the mean over the samples. Depth is copied only where the softening reads
// it: the driver takes one of the samples.
void ScenePicture::resolve() const {
    const gl::Stage stage{"resolve"};
    const GLbitfield layers =
        GL_COLOR_BUFFER_BIT | (soften_ ? static_cast<GLbitfield>(GL_DEPTH_BUFFER_BIT) : 0U);
    glBlitNamedFramebuffer(drawn_.target.name(),
                           resolved_.target.name(),
                           0,
                           0,
                           size_.x,
                           size_.y,
                           0,
                           0,
                           size_.x,
                           size_.y,
                           layers,
                           GL_NEAREST);
}

void ScenePicture::pass(unsigned framebuffer, unsigned program) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glUseProgram(program);
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

unsigned ScenePicture::softening(bool isFiner) {
    if (!isFiner) return soften_->name();
    if (!softenFiner_)
        softenFiner_.emplace(gl::makeProgram({"quad.vert", "soften.frag"},
                                             {{"soften_taps.glsl", "soften_more_taps.glsl"}}));
    return softenFiner_->name();
}

unsigned ScenePicture::finish(bool isFiner) {
    // begin() comes first.
    assert(size_.x > 0);
    assert(size_.y > 0);
    glDisable(GL_DEPTH_TEST);
    if (quality_.samples > 1) resolve();
    const Layer& light = quality_.samples > 1 ? resolved_ : drawn_;
    unsigned seen = light.colour.name();
    if (soften_) {
        const gl::Stage stage{"soften"};
        glBindTextureUnit(shaders::kSceneUnit, seen);
        glBindTextureUnit(shaders::kDepthUnit, light.depth.name());
        pass(softened_.name(), softening(isFiner));
        seen = softenedColour_.name();
    }
    if (quality_.bloom) {
        const gl::Stage stage{"bloom"};
        glGenerateTextureMipmap(seen);
    }
    const gl::Stage stage{"tone"};
    glBindTextureUnit(shaders::kSceneUnit, seen);
    pass(toned_.name(), tone_.name());
    return display_.name();
}

}  // namespace aquarama::scene
