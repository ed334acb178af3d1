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

// Mip levels of the picture that glow.frag reads. The last is the one that its widest ring
// needs where a radian has 16 000 pixels.
constexpr int kBloomLevels = 8;
static_assert(1 << (kBloomLevels - 1) == ScenePicture::kPartPixels);

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

// Of the picture of the glow, for a picture of this size.
glm::ivec2 glowSize(glm::ivec2 size) {
    constexpr int kSmaller = 4;
    return (size + kSmaller - 1) / kSmaller;
}

gl::ProgramHandle makeResolve(int samples) {
    if (samples > 1) return gl::makeProgram({"quad.vert", "resolve.frag"});
    return gl::makeProgram({"quad.vert", "resolve.frag"},
                           {{"many_samples.glsl", "one_sample.glsl"}});
}

gl::ProgramHandle makeTone(bool bloom) {
    if (!bloom) return gl::makeProgram({"quad.vert", "tone.frag"});
    return gl::makeProgram({"quad.vert", "tone.frag"}, {{"scene_light.glsl", "bloom.glsl"}});
}

}  // namespace

void ScenePicture::Pass::resize(glm::ivec2 sizePixels, int levels) {
    light = makeTexture(GL_RGBA16F, sizePixels, levels, Edge::Clamp);
    target = makeTarget(light);
}

ScenePicture::ScenePicture(const Quality& quality)
    : quality_{quality}, tone_{makeTone(quality.bloom)} {
    assert(quality.samples == 1 || quality.samples == shaders::kSamples);
    if (quality.samples > 1 || quality.softening) resolve_.emplace(makeResolve(quality.samples));
    if (quality.softening) soften_.emplace(gl::makeProgram({"quad.vert", "soften.frag"}));
    if (quality.bloom) glow_.emplace(gl::makeProgram({"quad.vert", "glow.frag"}));
}

void ScenePicture::allocate(glm::ivec2 sizePixels) {
    size_ = sizePixels;
    // Only the texture that the glow is made of has mip levels.
    const int levels = quality_.bloom ? bloomLevels(size_) : 1;
    colour_ = makeLayer(GL_RGBA16F, size_, quality_.samples, resolve_ ? 1 : levels);
    depth_ = makeLayer(GL_DEPTH_COMPONENT32F, size_, quality_.samples);
    drawn_ = makeTarget(colour_);
    glNamedFramebufferTexture(drawn_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
    if (resolve_) resolve_->resize(size_, soften_ ? 1 : levels);
    if (soften_) soften_->resize(size_, levels);
    if (glow_) glow_->resize(glowSize(size_), 1);
    tone_.resize(size_, 1);
}

void ScenePicture::begin(glm::ivec2 sizePixels) {
    assert(sizePixels.x > 0);
    assert(sizePixels.y > 0);
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

void ScenePicture::draw(const Pass& pass, unsigned program, unsigned light) const {
    glBindTextureUnit(shaders::kSceneUnit, light);
    glBindFramebuffer(GL_FRAMEBUFFER, pass.target.name());
    glUseProgram(program);
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePicture::resolve() const {
    const gl::Stage stage{"resolve"};
    glBindTextureUnit(shaders::kDepthUnit, depth_.name());
    draw(*resolve_, resolve_->program.name(), colour_.name());
}

unsigned ScenePicture::softening(bool isFiner) {
    if (!isFiner) return soften_->program.name();
    if (!softenFiner_)
        softenFiner_.emplace(gl::makeProgram({"quad.vert", "soften.frag"},
                                             {{"soften_taps.glsl", "soften_more_taps.glsl"}}));
    return softenFiner_->name();
}

void ScenePicture::spreadLight(unsigned light) const {
    const gl::Stage stage{"bloom"};
    glGenerateTextureMipmap(light);
    const glm::ivec2 smaller = glowSize(size_);
    glViewport(0, 0, smaller.x, smaller.y);
    draw(*glow_, glow_->program.name(), light);
    glViewport(0, 0, size_.x, size_.y);
    glBindTextureUnit(shaders::kGlowUnit, glow_->light.name());
}

unsigned ScenePicture::finish(bool isFiner) {
    // begin() comes first.
    assert(size_.x > 0);
    assert(size_.y > 0);
    glDisable(GL_DEPTH_TEST);
    unsigned seen = colour_.name();
    if (resolve_) {
        resolve();
        seen = resolve_->light.name();
    }
    if (soften_) {
        const gl::Stage stage{"soften"};
        draw(*soften_, softening(isFiner), seen);
        seen = soften_->light.name();
    }
    if (glow_) spreadLight(seen);
    const gl::Stage stage{"tone"};
    draw(tone_, tone_.program.name(), seen);
    return tone_.light.name();
}

}  // namespace aquarama::scene
