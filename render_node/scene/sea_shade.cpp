// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/sea_shade.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "render_node/gl/program.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// Side of the map of fish, metres on the surface.
constexpr float kFishMetres = 32.0F;
// Mip levels of the maps. Coarser ones serve wider, softer shadows; of the fish map only the finest
// is used where quality is not fine.
constexpr int kPlaceLevels = 7;
constexpr int kFishLevels = 6;

// A parallel projection along the rays: a place is mapped to where its ray meets the surface. Depth
// is its height, 1 at the surface and 0 at kMapDepthMetres below. towardsLight must point upwards.
glm::mat4 alongRays(glm::vec3 towardsLight) {
    assert(towardsLight.y > 0.0F);
    constexpr float kScale = 2.0F / shaders::kPlaceMetres;
    glm::mat4 clip{0.0F};
    clip[0][0] = kScale;
    clip[2][1] = kScale;
    clip[1] = {-kScale * towardsLight.x / towardsLight.y,
               -kScale * towardsLight.z / towardsLight.y,
               1.0F / shaders::kMapDepthMetres,
               0.0F};
    clip[3] = {0.0F, 0.0F, 1.0F, 1.0F};
    return clip;
}

}  // namespace

SeaShade::SeaShade(const LightQuality& quality)
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
      fishProgram_{
          gl::makeProgram({"fish_shadow.vert", "fish_shadow.frag"}, replacementsOf(quality))} {
    assert(quality_.fishShadowTexels >> (kFishLevels - 1) > 0);
    clear();
}

void SeaShade::clear() {
    // A height below everything, and its square.
    const glm::vec2 nothing{-shaders::kMapDepthMetres,
                            shaders::kMapDepthMetres * shaders::kMapDepthMetres};
    for (int level = 0; level < kPlaceLevels; ++level)
        for (const gl::Texture* heights : {&sunHeights_, &topHeights_})
            glClearTexImage(heights->name(), level, GL_RG, GL_FLOAT, &nothing);
    for (int level = 0; level < kFishLevels; ++level)
        glClearTexImage(fishOnTheWay_.name(), level, GL_RGBA, GL_FLOAT, nullptr);
}

void SeaShade::setPlace(const std::function<void(const glm::mat4&)>& drawPlace) {
    assert(drawPlace != nullptr);
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
        // The map's x and y are world x and z, a view from below, which reverses the orientation of
        // triangles.
        glFrontFace(GL_CW);
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
    glBindTextureUnit(shaders::kMomentDepthsUnit, depth.name());
    glBindVertexArray(empty_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

// The middle is where the sun's ray to the eye meets the surface, rounded to texels of the coarsest
// level so that all levels stay aligned.
glm::vec4 SeaShade::fishWindow(glm::vec3 sharedEyeMetres) const {
    const glm::vec3 sun = sunInWater();
    const glm::vec2 middle = glm::vec2{sharedEyeMetres.x, sharedEyeMetres.z} -
                             glm::vec2{sun.x, sun.z} / sun.y * sharedEyeMetres.y;
    const float coarsest =
        kFishMetres / static_cast<float>(quality_.fishShadowTexels >> (kFishLevels - 1));
    return {glm::round(middle / coarsest) * coarsest, 1.0F / kFishMetres, 0.0F};
}

void SeaShade::updateFish(const surface::SchoolSurface& school) {
    const gl::Stage stage{"fish shadows"};
    glBindFramebuffer(GL_FRAMEBUFFER, fishTarget_.name());
    glViewport(0, 0, quality_.fishShadowTexels, quality_.fishShadowTexels);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    if (school.fishInRecords() > 0) {
        school.bindRecords();
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glUseProgram(fishProgram_.name());
        glUniform1f(shaders::kFractionLocation, school.fraction());
        glBindVertexArray(empty_.name());
        glDrawArraysInstanced(
            GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(school.fishInRecords()));
        glDisable(GL_BLEND);
    }
    // Coarse tiers read level 0 alone.
    if (quality_.isFine) glGenerateTextureMipmap(fishOnTheWay_.name());
}

void SeaShade::bind() const {
    glBindTextureUnit(shaders::kSunHeightsUnit, sunHeights_.name());
    glBindTextureUnit(shaders::kTopHeightsUnit, topHeights_.name());
    glBindTextureUnit(shaders::kFishOnTheWayUnit, fishOnTheWay_.name());
}

}  // namespace aquarama::scene
