// SPDX-License-Identifier: Apache-2.0
#include "render_node/light/scene.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <vector>

#include <glm/matrix.hpp>

#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/light/scene_picture.h"
#include "render_node/light/sea_light.h"
#include "render_node/reef/ground.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/quality.h"
#include "render_node/reef/reef.h"
#include "render_node/shaders/frame_uniforms.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::scene {

namespace {

// The share of noon's light that the water gets from the sun and, by colour, from the sky. A low
// sun is mirrored away; what is left then comes from above, and is bluer. Never nothing: a wall
// that is dark is broken. Exactly 1 at noon.
glm::vec4 daylightOf(float daylight) {
    const glm::vec4 night{0.02F, 0.16F, 0.24F, 0.36F};
    const float sun = daylight * daylight;
    return glm::mix(night, glm::vec4{1.0F}, glm::vec4{sun, glm::vec3{daylight}});
}

// Over the submarine's bow. Weak by day near the surface, where it would only flatten what the sun
// models; stronger where the sun does not reach. In the deep the exposure has risen for what is
// left of the sun, so the lamp needs as much less power; at night it has not.
glm::vec4 lampOf(const SceneFrame& frame, float exposure) {
    const glm::vec3 above{0.0F, 1.0F, 0.0F};
    const float deep = glm::smoothstep(9.0F, 24.0F, -frame.eyePositionMetres.y);
    const float power = glm::mix(8.0F, 12.0F, deep) / exposure + 8.0F * (1.0F - frame.daylight);
    return {frame.eyePositionMetres + above, power};
}

// Shaders count time in 32-bit floats, which months of show would make coarse: they begin anew
// after so long, in which snow drifts whole boxes, clouds whole tiles, and fins beat whole times.
constexpr double kClockSeconds = 9000;

// What is the same for all views of a frame.
shaders::FrameUniforms frameUniforms(const SceneFrame& frame,
                                     const SeaLight& light,
                                     float pixelRadians) {
    shaders::FrameUniforms uniforms{};
    const auto clock = static_cast<float>(std::fmod(frame.timeSeconds, kClockSeconds));
    uniforms.eyeAndTime = glm::vec4(frame.eyePositionMetres, clock);
    uniforms.sharedEyeAndPixel = glm::vec4(frame.eyePositionMetres, pixelRadians);
    uniforms.sunAndFilterDepth = glm::vec4(
        sunInWater(), static_cast<float>(filterDepthMetres(-double{frame.eyePositionMetres.y})));
    uniforms.kdAndExposure = light.kdAndExposure(frame.eyePositionMetres);
    uniforms.daylight = daylightOf(frame.daylight);
    uniforms.lamp = lampOf(frame, uniforms.kdAndExposure.w);
    return uniforms;
}

void setView(shaders::FrameUniforms& uniforms, const View& view) {
    uniforms.clipFromWorld = view.clipFromCamera * view.cameraFromWorld;
    uniforms.worldFromClip = glm::inverse(uniforms.clipFromWorld);
    const glm::vec3 eye(glm::inverse(view.cameraFromWorld)[3]);
    uniforms.eyeAndTime = glm::vec4(eye, uniforms.eyeAndTime.w);
    const glm::vec2 size(view.sizePixels);
    uniforms.viewport = glm::vec4(size, 1.0F / size);
}

// All that stands on the sea floor. In the open sea it lies too deep to be seen.
struct Bottom {
    Ground ground;
    Reef reef;
};

// Made while this thread compiles shaders.
struct BottomTables {
    explicit BottomTables(const SceneOptions& options) {
        if (options.place != config::PlaceKind::Reef) return;
        reef = std::async(
            std::launch::async, reefTables, place::PlaceKey{options.seed, options.place});
        ground = std::async(std::launch::async, groundTables, options.seed);
    }
    std::future<ReefTables> reef;
    std::future<GroundTables> ground;
};

}  // namespace

struct SceneRenderer::Parts {
    Parts(const SceneOptions& chosen, std::span<const surface::SchoolSpecies> cast)
        : options{chosen},
          quality{qualityOf(chosen.quality)},
          shaders{replacementsOf(quality.light)},
          bottomTables{chosen},
          light{{chosen.seed, chosen.water, quality.light}},
          picture{quality},
          school{cast,
                 {.culling = chosen.culling,
                  .levelsOfDetail = chosen.levelsOfDetail,
                  .finest =
                      quality.closeUps ? surface::DetailLevel::CloseUp : surface::DetailLevel::Hero,
                  .fineness = quality.fishFineness},
                 surface::makeSkinPrograms(shaders)},
          food{shaders},
          surface{gl::makeProgram({"water_surface.vert", "water_surface.frag"}, shaders)},
          water{gl::makeProgram({"quad.vert", "water.frag"}, shaders)},
          snow{gl::makeProgram({"snow.vert", "snow.frag"}, shaders)} {
        if (bottomTables.reef.valid())
            bottom.emplace(Ground{bottomTables.ground.get(), shaders},
                           Reef{bottomTables.reef.get(), quality});
        if (bottom && quality.light.isFine) bakeShadows();
    }

    void setUniforms() const;
    void bakeShadows();
    void drawSolids(const Viewpoint& viewpoint);
    void drawWater() const;
    void drawSnow() const;

    SceneOptions options;
    Quality quality;
    gl::Replacements shaders;  // of the tier
    BottomTables bottomTables;
    shaders::FrameUniforms uniforms{};
    std::vector<FoodParticle> specks;
    gl::Buffer frameBlock{
        gl::makeBuffer(sizeof(shaders::FrameUniforms), "frame", GL_DYNAMIC_STORAGE_BIT)};
    gl::VertexArray empty;
    SeaLight light;
    std::optional<Bottom> bottom;
    ScenePicture picture;
    surface::SchoolSurface school;
    FoodSpecks food;
    gl::ProgramHandle surface, water, snow;
};

void SceneRenderer::Parts::setUniforms() const {
    glNamedBufferSubData(frameBlock.name(), 0, sizeof(uniforms), &uniforms);
    glBindBufferBase(GL_UNIFORM_BUFFER, shaders::kFrameBlock, frameBlock.name());
}

// Of the place as it stands, as rays of light see it; as fine as the maps' texels.
void SceneRenderer::Parts::bakeShadows() {
    constexpr glm::vec4 kFarAboveWithCoarsePixels{0.0F, 30.0F, 0.0F, 0.002F};
    const Reef::DepthPrograms reefPrograms = bottom->reef.depthPrograms();
    const gl::ProgramHandle groundProgram = Ground::depthProgram();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    uniforms.sharedEyeAndPixel = kFarAboveWithCoarsePixels;
    light.shade().setPlace([&](const glm::mat4& clipFromWorld) {
        uniforms.clipFromWorld = clipFromWorld;
        setUniforms();
        light.bind();
        bottom->reef.cull({.culling = false, .levelsOfDetail = options.levelsOfDetail});
        bottom->reef.drawDepths(reefPrograms);
        bottom->ground.drawDepths(groundProgram,
                                  Viewpoint{surface::frustumOf(clipFromWorld),
                                            place::kEyePosition,
                                            false,
                                            options.levelsOfDetail});
    });
}

// Near things first, so that what they hide is never shaded.
void SceneRenderer::Parts::drawSolids(const Viewpoint& viewpoint) {
    const gl::Stage stage{"place"};
    if (!bottom) return;
    bottom->reef.draw();
    bottom->ground.draw(viewpoint);
}

void SceneRenderer::Parts::drawWater() const {
    const gl::Stage stage{"water"};
    glBindVertexArray(empty.name());
    glUseProgram(surface.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glUseProgram(water.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SceneRenderer::Parts::drawSnow() const {
    const gl::Stage stage{"snow"};
    glBindVertexArray(empty.name());
    glUseProgram(snow.name());
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDrawArrays(GL_POINTS, 0, quality.light.flakes);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

SceneRenderer::SceneRenderer(const SceneOptions& options,
                             std::span<const surface::SchoolSpecies> cast)
    : parts_{std::make_unique<Parts>(options, cast)} {}

SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::update(const SceneFrame& frame) {
    Parts& parts = *parts_;
    parts.uniforms = frameUniforms(frame, parts.light, parts.options.pixelRadians);
    parts.uniforms.bottom.x = parts.bottom ? 1.0F : 0.0F;
    parts.specks.assign(frame.food.begin(), frame.food.end());
    parts.setUniforms();
    parts.school.update(frame.fish);
    parts.school.bindRecords();
    if (parts.bottom)
        parts.bottom->reef.stir(parts.school.fishInRecords(), parts.school.fraction());
    parts.light.update(frame.timeSeconds, frame.eyePositionMetres);
    parts.light.shade().updateFish(parts.school);
}

unsigned SceneRenderer::draw(const View& view) {
    Parts& parts = *parts_;
    setView(parts.uniforms, view);
    parts.setUniforms();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const glm::vec3 eye(parts.uniforms.eyeAndTime);
    parts.light.bind();
    parts.light.drawShafts(eye, parts.uniforms.worldFromClip);
    parts.school.look(parts.uniforms.clipFromWorld,
                      {glm::vec3(parts.uniforms.sharedEyeAndPixel), parts.options.pixelRadians});
    // All that is computed before all that is drawn: between the two a driver may have to wait.
    if (parts.bottom)
        parts.bottom->reef.cull({parts.options.culling, parts.options.levelsOfDetail});
    parts.picture.begin(view.sizePixels);
    const Viewpoint viewpoint{surface::frustumOf(parts.uniforms.clipFromWorld),
                              glm::vec3(parts.uniforms.sharedEyeAndPixel),
                              parts.options.culling,
                              parts.options.levelsOfDetail,
                              parts.quality.placeDetail};
    parts.school.drawBodies();
    parts.drawSolids(viewpoint);
    parts.drawWater();
    parts.school.drawBlended();
    parts.food.update(parts.specks, viewpoint);
    parts.food.draw();
    parts.drawSnow();
    return parts.picture.finish();
}

}  // namespace aquarama::scene
