// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/shaft_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "render_node/gl/program.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// The texel of the octahedral map that holds a direction: the inverse of directionOf() in
// shaft.frag, with its border of one texel.
glm::vec2 shaftTexel(glm::vec3 direction, float texels) {
    const glm::vec3 size = glm::abs(direction);
    glm::vec2 p = glm::vec2(direction.x, direction.z) / (size.x + size.y + size.z);
    if (direction.y < 0.0F)
        p = (1.0F - glm::abs(glm::vec2(p.y, p.x))) *
            glm::vec2(p.x < 0.0F ? -1.0F : 1.0F, p.y < 0.0F ? -1.0F : 1.0F);
    return 0.5F * (texels + p * (texels - 2.0F));
}

// A rectangle of texels, high excluded.
struct Box {
    glm::ivec2 low{}, high{};
};

// The texels of the shaft map that a view reads. The rays of the picture are sampled on a grid of
// 25 x 25; a margin of a twentieth of the map covers what lies between the samples and the filter.
Box texelsInView(glm::vec3 eye, const glm::mat4& worldFromClip, int texels) {
    constexpr int kProbes = 24;
    glm::vec2 low{1.0e9F};
    glm::vec2 high{-1.0e9F};
    for (int y = 0; y <= kProbes; ++y)
        for (int x = 0; x <= kProbes; ++x) {
            const glm::vec4 near =
                worldFromClip * glm::vec4(2.0F * static_cast<float>(x) / kProbes - 1.0F,
                                          2.0F * static_cast<float>(y) / kProbes - 1.0F,
                                          1.0F,
                                          1.0F);
            const glm::vec2 texel = shaftTexel(glm::normalize(glm::vec3(near) / near.w - eye),
                                               static_cast<float>(texels));
            low = glm::min(low, texel);
            high = glm::max(high, texel);
        }
    const float margin = static_cast<float>(texels) / 20.0F;
    return {glm::max(glm::ivec2(low - margin), 0), glm::min(glm::ivec2(high + margin), texels)};
}

}  // namespace

ShaftMap::ShaftMap(const LightQuality& quality)
    : texels_{quality.shaftTexels},
      steps_{quality.shaftSteps},
      map_{makeTexture(GL_RGBA16F, glm::ivec2{texels_}, 1, Edge::Clamp)},
      target_{makeTarget(map_)},
      program_{gl::makeProgram({"quad.vert", "shaft.frag"}, replacementsOf(quality))} {}

void ShaftMap::draw(glm::vec3 eyeMetres,
                    const glm::mat4& worldFromClip,
                    const gl::Texture& causticLayers,
                    const SeaShade& shade) {
    const gl::Stage stage{"shafts"};
    const Box box = texelsInView(eyeMetres, worldFromClip, texels_);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glViewport(0, 0, texels_, texels_);
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y);
    glUseProgram(program_.name());
    glUniform1i(shaders::kTexelsLocation, texels_);
    glUniform1i(shaders::kStepsLocation, steps_);
    glBindTextureUnit(shaders::kCausticLayersUnit, causticLayers.name());
    shade.bind();
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace aquarama::scene
