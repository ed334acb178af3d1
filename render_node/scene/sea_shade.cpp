// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/sea_shade.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>

#include "render_node/gl/program.h"
#include "render_node/scene/shade.h"
#include "render_node/scene/texture.h"

namespace aquarama {

namespace {

constexpr float kPlaceMetres = 80.0F;     // as in shadow.glsl
constexpr float kMapDepthMetres = 64.0F;  // depth 0 of the maps of the place, as in moments.frag
constexpr float kFishMetres = 32.0F;      // side of the map of fish
constexpr int kPlaceLevels = 7;
constexpr int kFishLevels = 6;  // the finest alone where nobody reads the others
constexpr unsigned kFishBinding = 12;

// Parallel to the rays: a place goes to where its ray meets the surface; depth is its height.
glm::mat4 alongRays(glm::vec3 towardsLight) {
    constexpr float kScale = 2.0F / kPlaceMetres;
    glm::mat4 clip{0.0F};
    clip[0][0] = kScale;
    clip[2][1] = kScale;
    clip[1] = {-kScale * towardsLight.x / towardsLight.y,
               -kScale * towardsLight.z / towardsLight.y,
               1.0F / kMapDepthMetres,
               0.0F};
    clip[3] = {0.0F, 0.0F, 1.0F, 1.0F};
    return clip;
}

}  // namespace

SeaShade::SeaShade(const LightQuality& quality, std::size_t mostFish)
    : quality_{quality},
      sunHeights_{
          makeTexture(GL_RG32F, glm::ivec2{quality.shadowTexels}, kPlaceLevels, Edge::Clamp)},
      topHeights_{
          makeTexture(GL_RG32F, glm::ivec2{quality.shadowTexels}, kPlaceLevels, Edge::Clamp)},
      fishOnTheWay_{
          makeTexture(GL_RGBA32F, glm::ivec2{quality.fishShadowTexels}, kFishLevels, Edge::Clamp)},
      sunTarget_{makeTarget(sunHeights_)},
      topTarget_{makeTarget(topHeights_)},
      fishTarget_{makeTarget(fishOnTheWay_)},
      moments_{gl::makeProgram({"quad.vert", "moments.frag"})},
      fishProgram_{gl::makeProgram({"fish_shadow.vert", "fish_shadow.frag"})} {
    throwers_.reserve(2 * mostFish);
    const std::size_t bytes = std::max<std::size_t>(2 * mostFish, 1) * sizeof(glm::vec4);
    glNamedBufferStorage(
        fish_.name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    clearPlace();
}

void SeaShade::clearPlace() {
    const glm::vec2 nothing{-kMapDepthMetres, kMapDepthMetres * kMapDepthMetres};
    for (int level = 0; level < kPlaceLevels; ++level)
        for (const gl::Texture* heights : {&sunHeights_, &topHeights_})
            glClearTexImage(heights->name(), level, GL_RG, GL_FLOAT, &nothing);
}

void SeaShade::setPlace(const std::function<void(const glm::mat4&)>& drawPlace) {
    const glm::ivec2 size{quality_.shadowTexels};
    const gl::Texture depth = makeTexture(GL_DEPTH_COMPONENT32F, size, 1, Edge::Clamp);
    const gl::Framebuffer target;
    glNamedFramebufferTexture(target.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
    const auto draw = [&](glm::vec3 towardsLight, const gl::Framebuffer& heights) {
        glBindFramebuffer(GL_FRAMEBUFFER, target.name());
        glViewport(0, 0, size.x, size.y);
        glDepthMask(GL_TRUE);
        glClearDepth(0.0);
        glClear(GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GEQUAL);
        glFrontFace(GL_CW);  // the map is laid out as seen from below
        drawPlace(alongRays(towardsLight));
        glFrontFace(GL_CCW);
        glDisable(GL_DEPTH_TEST);
        takeMoments(depth, heights);
    };
    draw(sunInWater(), sunTarget_);
    draw({0.0F, 1.0F, 0.0F}, topTarget_);
    glGenerateTextureMipmap(sunHeights_.name());
    glGenerateTextureMipmap(topHeights_.name());
}

void SeaShade::takeMoments(const gl::Texture& depth, const gl::Framebuffer& heights) {
    glBindFramebuffer(GL_FRAMEBUFFER, heights.name());
    glUseProgram(moments_.name());
    glBindTextureUnit(0, depth.name());
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

glm::vec4 SeaShade::fishWindow(glm::vec3 sharedEyeMetres) const {
    const glm::vec3 sun = sunInWater();
    const glm::vec2 middle = glm::vec2{sharedEyeMetres.x, sharedEyeMetres.z} -
                             glm::vec2{sun.x, sun.z} / sun.y * sharedEyeMetres.y;
    const float coarsest =
        kFishMetres / static_cast<float>(quality_.fishShadowTexels >> (kFishLevels - 1));
    return {glm::round(middle / coarsest) * coarsest, 1.0F / kFishMetres, 0.0F};
}

void SeaShade::updateFish(std::span<const PresentedFish> fish) {
    throwers_.clear();
    for (const PresentedFish& one : fish) {
        if (isAway(one)) continue;
        const glm::quat turn{one.rotation.w, one.rotation.x, one.rotation.y, one.rotation.z};
        throwers_.emplace_back(one.positionMetres, one.lengthMetres);
        throwers_.emplace_back(turn * glm::vec3{1.0F, 0.0F, 0.0F}, 0.0F);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, fishTarget_.name());
    glViewport(0, 0, quality_.fishShadowTexels, quality_.fishShadowTexels);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!throwers_.empty()) {
        glNamedBufferSubData(fish_.name(),
                             0,
                             static_cast<GLsizeiptr>(throwers_.size() * sizeof(glm::vec4)),
                             throwers_.data());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFishBinding, fish_.name());
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glUseProgram(fishProgram_.name());
        glBindVertexArray(empty_.name());
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<int>(throwers_.size() / 2));
        glDisable(GL_BLEND);
    }
    if (quality_.isFine) glGenerateTextureMipmap(fishOnTheWay_.name());
}

void SeaShade::bind() const {
    glBindTextureUnit(21, sunHeights_.name());
    glBindTextureUnit(22, topHeights_.name());
    glBindTextureUnit(18, fishOnTheWay_.name());
}

}  // namespace aquarama
