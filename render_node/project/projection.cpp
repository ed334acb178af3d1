// SPDX-License-Identifier: Apache-2.0
#include "render_node/project/projection.h"

#include "render_node/gl/program.h"

namespace aquarama {

namespace {

// Places in project.frag.
constexpr GLuint kSceneUnit = 0;
constexpr GLuint kMapUnit = 1;
constexpr GLint kHeight = 0;
constexpr GLint kSeed = 1;
constexpr GLint kDither = 2;
constexpr GLint kBlendMask = 3;

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
    glSamplerParameteri(bilinear_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(bilinear_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(bilinear_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(bilinear_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Projection::draw(const Draw& what) const {
    glBindFramebuffer(GL_FRAMEBUFFER, what.framebuffer);
    glViewport(0, 0, size_.x, size_.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_DITHER);
    glUseProgram(program_.name());
    glBindTextureUnit(kSceneUnit, what.sceneTexture);
    glBindSampler(kSceneUnit, bilinear_.name());
    glBindTextureUnit(kMapUnit, map_.name());
    glUniform1i(kHeight, size_.y);
    glUniform1ui(kSeed, channelId_ * 2U + static_cast<GLuint>(what.frame.value % 2));
    glUniform1i(kDither, what.encoding == Encoding::Dithered8 ? 1 : 0);
    glUniform1i(kBlendMask, what.blendMask ? 1 : 0);
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(kSceneUnit, 0);
}

}  // namespace aquarama
