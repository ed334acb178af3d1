// SPDX-License-Identifier: Apache-2.0
#include "render_node/project/projection.h"

#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::project {

namespace {

// Places in project.frag and project_pair.frag.
// Places in project.glsl, and one in project_pair.frag.

void beginPass(const Projection::Draw& what,
               const gl::ProgramHandle& program,
               glm::ivec2 size,
               std::uint32_t channelId) {
    glBindFramebuffer(GL_FRAMEBUFFER, what.framebuffer);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_DITHER);
    glUseProgram(program.name());
    glUniform2i(shaders::kSizeLocation, size.x, size.y);
    glUniform1ui(shaders::kSeedLocation,
                 channelId * 2U + static_cast<GLuint>(what.frame.value % 2));
    glUniform1i(shaders::kDitheredLocation, what.encoding == Encoding::Dithered8 ? 1 : 0);
    glUniform1i(shaders::kBlendMaskLocation, what.blendMask ? 1 : 0);
}

void makeBilinear(const gl::Sampler& sampler) {
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

Projection::Projection(const ProjectionMap& map, std::uint32_t channelId)
    : size_{map.sizePixels},
      channelId_{channelId},
      program_{gl::makeProgram({"quad.vert", "project.frag"})},
      map_{GL_TEXTURE_2D} {
    glTextureStorage2D(map_.name(), 1, GL_RGBA32F, size_.x, size_.y);
    glTextureSubImage2D(
        map_.name(), 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, map.placeAndWeight.data());
    glObjectLabel(GL_TEXTURE, map_.name(), -1, "projection map");
    makeBilinear(bilinear_);
}

void Projection::draw(const Draw& what) const {
    beginPass(what, program_, size_, channelId_);
    glBindTextureUnit(shaders::kSceneUnit, what.sceneTexture);
    glBindSampler(shaders::kSceneUnit, bilinear_.name());
    glBindTextureUnit(shaders::kPlacesUnit, map_.name());
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(shaders::kSceneUnit, 0);
}

PairProjection::PairProjection(glm::ivec2 sizePixels,
                               std::uint32_t channelId,
                               config::StereoMode mode)
    : size_{sizePixels},
      channelId_{channelId},
      mode_{mode},
      program_{gl::makeProgram({"quad.vert", "project_pair.frag"})} {
    makeBilinear(bilinear_);
}

void PairProjection::draw(const Eye& left, const Eye& right, const Projection::Draw& both) const {
    beginPass(both, program_, size_, channelId_);
    glUniform1i(shaders::kModeLocation, static_cast<GLint>(mode_));
    glBindTextureUnit(shaders::kSceneUnit, left.sceneTexture);
    glBindTextureUnit(shaders::kPlacesUnit, left.mapTexture);
    glBindTextureUnit(shaders::kRightSceneUnit, right.sceneTexture);
    glBindTextureUnit(shaders::kRightPlacesUnit, right.mapTexture);
    glBindSampler(shaders::kSceneUnit, bilinear_.name());
    glBindSampler(shaders::kRightSceneUnit, bilinear_.name());
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(shaders::kSceneUnit, 0);
    glBindSampler(shaders::kRightSceneUnit, 0);
}

glm::vec2 pixelOfEye(config::StereoMode mode, glm::ivec2 sizePixels, glm::vec2 pixel) {
    const glm::vec2 half = glm::vec2(sizePixels) / 2.0F;
    if (mode == config::StereoMode::SideBySide)
        pixel.x = 2 * (pixel.x < half.x ? pixel.x : pixel.x - half.x);
    if (mode == config::StereoMode::TopBottom)
        pixel.y = 2 * (pixel.y < half.y ? pixel.y : pixel.y - half.y);
    return pixel;
}

}  // namespace aquarama::project
