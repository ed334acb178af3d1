// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <future>
#include <optional>
#include <vector>

#include <glm/matrix.hpp>

#include "common/base/units.h"
#include "common/place/current.h"
#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/quality/quality.h"
#include "render_node/reef/ground.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/reef.h"
#include "render_node/scene/day_light.h"
#include "render_node/scene/scene_picture.h"
#include "render_node/scene/sea_light.h"
#include "render_node/shaders/frame_uniforms.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::scene {

namespace {

// The floodlight 1 m above the shared eye: position in the world, and power (w). By day it is weak
// near the surface, where it would flatten the shading by the sun, and stronger where the sun does
// not reach. In the deep the exposure is higher, so the power is divided by it; at night the
// exposure is the same as by day, so power is added.
glm::vec4 lampOf(const SceneFrame& frame, const DayLight& dayLight, float exposure) {
    const glm::vec3 above{0.0F, 1.0F, 0.0F};
    const float deep = glm::smoothstep(9.0F, 24.0F, -frame.eyePositionMetres.y);
    const float power = glm::mix(8.0F, 12.0F, deep) / exposure + 8.0F * (1.0F - frame.daylight);
    return {frame.eyePositionMetres + above, power * dayLight.lamp};
}

// Shaders count time in 32-bit floats, which would become coarse after months. The clock therefore
// restarts after this many seconds, a whole number of periods of all that the shaders derive from
// it: drifting snow, clouds and fins.
constexpr double kClockSeconds = 9000;

// Way and velocity of the current far from boulders, between two ticks too.
glm::vec4 currentOf(const config::SceneCurrent& current, double timeSeconds) {
    const double ticks = timeSeconds * static_cast<double>(kTicksPerSecond);
    const auto tick = static_cast<std::int64_t>(std::floor(ticks));
    const auto share = static_cast<float>(ticks - std::floor(ticks));
    const glm::vec3 velocity = place::openCurrent(current, tick);
    const glm::vec3 way =
        place::openDrift(current, tick) + velocity * (share / static_cast<float>(kTicksPerSecond));
    return {way.x, way.z, velocity.x, velocity.z};
}

// The uniforms that all views of a frame share; the rest is left to setView().
shaders::FrameUniforms frameUniforms(const SceneFrame& frame,
                                     const WaterTextures& water,
                                     const config::SceneCurrent& current,
                                     float pixelRadians) {
    shaders::FrameUniforms uniforms{};
    const auto clock = static_cast<float>(std::fmod(frame.timeSeconds, kClockSeconds));
    uniforms.eyeAndTime = glm::vec4(frame.eyePositionMetres, clock);
    uniforms.sharedEyeAndPixel = glm::vec4(frame.eyePositionMetres, pixelRadians);
    uniforms.sunAndFilterDepth = glm::vec4(
        sunInWater(), static_cast<float>(filterDepthMetres(-double{frame.eyePositionMetres.y})));
    uniforms.kdAndExposure = water.kdAndExposure(frame.eyePositionMetres);
    uniforms.grading.x = frame.colourReturned;
    const DayLight dayLight = dayLightAt(frame.timeOfDay, frame.daylight);
    uniforms.sunlight = glm::vec4(dayLight.sun, 0.0F);
    uniforms.skylight = glm::vec4(dayLight.sky, 0.0F);
    uniforms.lamp = lampOf(frame, dayLight, uniforms.kdAndExposure.w);
    uniforms.current = currentOf(current, frame.timeSeconds);
    return uniforms;
}

// What is drawn of a view.
PixelArea drawnOf(const View& view) {
    return view.part.value_or(PixelArea{{0, 0}, view.sizePixels});
}

// From the clip space of the whole picture to that of a part.
glm::dmat4 partFromWhole(const PixelArea& part, glm::ivec2 wholePixels) {
    const glm::dvec2 share = glm::dvec2(part.size) / glm::dvec2(wholePixels);
    const glm::dvec2 middle =
        (2.0 * glm::dvec2(part.corner) + glm::dvec2(part.size)) / glm::dvec2(wholePixels) - 1.0;
    glm::dmat4 matrix(1.0);
    for (int axis = 0; axis < 2; ++axis) {
        matrix[axis][axis] = 1.0 / share[axis];
        matrix[3][axis] = -middle[axis] / share[axis];
    }
    return matrix;
}

// Pixels in a radian, in the middle of the whole picture.
float pixelsARadian(const glm::mat4& clipFromWorld, int rows) {
    const glm::vec3 row(clipFromWorld[0].y, clipFromWorld[1].y, clipFromWorld[2].y);
    return 0.5F * static_cast<float>(rows) * glm::length(row);
}

// Fills in the members that depend on the view: matrices, the position of this eye, sizes, and the
// angle of a pixel.
void setView(shaders::FrameUniforms& uniforms, const View& view, float wallPixelRadians) {
    const glm::mat4 whole = view.clipFromCamera * view.cameraFromWorld;
    const PixelArea drawn = drawnOf(view);
    uniforms.clipFromWorld = glm::mat4(partFromWhole(drawn, view.sizePixels) * glm::dmat4(whole));
    uniforms.worldFromClip = glm::inverse(uniforms.clipFromWorld);
    const glm::vec3 eye(glm::inverse(view.cameraFromWorld)[3]);
    uniforms.eyeAndTime = glm::vec4(eye, uniforms.eyeAndTime.w);
    uniforms.sharedEyeAndPixel.w = wallPixelRadians / view.finer;
    uniforms.viewport =
        glm::vec4(drawn.size, view.sizePixels.y, pixelsARadian(whole, view.sizePixels.y));
}

// The sea floor with rocks and plants. The open sea has none: its floor is too deep to be seen.
struct Bottom {
    Ground ground;
    Reef reef;
};

// Tables of the sea floor, made by two threads while this one compiles shaders. The futures stay
// invalid in the open sea.
struct BottomTables {
    explicit BottomTables(const SceneOptions& options) {
        if (options.place.kind != config::PlaceKind::Reef) return;
        reef = std::async(std::launch::async, reefTables, options.place);
        ground = std::async(std::launch::async, groundTables, options.place);
    }
    std::future<ReefTables> reef;
    std::future<GroundTables> ground;
};

}  // namespace

// The members in the order in which they are made: the tables start first, programs and textures
// follow, and the body of the constructor waits for the tables.
struct SceneRenderer::Parts {
    Parts(const SceneOptions& chosen, std::span<const surface::SchoolSpecies> cast)
        : options{chosen},
          quality{qualityOf(chosen.quality)},
          shaders{replacementsOf(quality.light)},
          bottomTables{chosen},
          light{{chosen.place.seed, chosen.water, quality.light}},
          picture{quality},
          school{cast,
                 {.culling = chosen.culling,
                  .levelsOfDetail = chosen.levelsOfDetail,
                  .finest =
                      quality.closeUps ? surface::DetailLevel::CloseUp : surface::DetailLevel::Hero,
                  .fineness = quality.fishFineness,
                  .skinLevelsLeftOut = quality.skinLevelsLeftOut},
                 surface::makeSkinPrograms(shaders)},
          food{shaders},
          surface{gl::makeProgram({"water_surface.vert", "water_surface.frag"}, shaders)},
          water{gl::makeProgram({"quad.vert", "water.frag"}, shaders)},
          snow{gl::makeProgram({"snow.vert", "snow.frag"}, shaders)} {
        if (bottomTables.reef.valid())
            bottom = Bottom{Ground{bottomTables.ground.get(), quality.light},
                            Reef{bottomTables.reef.get(), quality}};
        if (bottom && quality.light.isFine) bakeShadows();
    }

    // Uploads the uniforms and binds them.
    void setUniforms() const;
    // Draws the shadow maps of the place, once.
    void bakeShadows();
    // Selects what a view shows of the place. finer: how many of its pixels lie along one of the
    // wall's.
    void cullPlace(float finer) const;
    void drawSolids();
    void drawWater() const;
    void drawSnow() const;

    SceneOptions options;
    Quality quality;
    // Includes that the tier of quality replaces.
    gl::Replacements shaders;
    BottomTables bottomTables;
    shaders::FrameUniforms uniforms{};
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

// Draws the static place into the shadow maps. Levels of detail are chosen for an eye far above
// with coarse pixels, 2 mrad, so that the meshes are about as fine as the texels of the maps.
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
        const PlaceRule rule{.culling = false, .levelsOfDetail = options.levelsOfDetail};
        bottom->reef.cull(rule);
        bottom->ground.cull(rule, place::kEyePosition, 1.0F);
        bottom->reef.drawDepths(reefPrograms);
        bottom->ground.drawDepths(groundProgram);
    });
}

void SceneRenderer::Parts::cullPlace(float finer) const {
    if (!bottom) return;
    const PlaceRule rule{options.culling, options.levelsOfDetail};
    bottom->reef.cull(rule);
    bottom->ground.cull(rule, glm::vec3(uniforms.sharedEyeAndPixel), quality.placeReach * finer);
}

// The reef before the sand, so that the depth test saves shading sand that the reef hides.
void SceneRenderer::Parts::drawSolids() {
    const gl::Stage stage{"place"};
    if (!bottom) return;
    bottom->reef.draw();
    bottom->ground.draw();
}

// The surface as a square of four vertices, then open water on the far plane: it passes the depth
// test only where nothing else was drawn.
void SceneRenderer::Parts::drawWater() const {
    const gl::Stage stage{"water"};
    glBindVertexArray(empty.name());
    glUseProgram(surface.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glUseProgram(water.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Marine snow: points of light, added over everything and hidden by what is nearer.
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

void SceneRenderer::wear(const body::SkinsByNumber& skins, std::size_t most) {
    parts_->school.wear(skins, most);
}

void SceneRenderer::update(const SceneFrame& frame) {
    assert(std::isfinite(frame.timeSeconds));
    Parts& parts = *parts_;
    parts.light.water().grade(double{frame.colourReturned});
    parts.uniforms = frameUniforms(
        frame, parts.light.water(), parts.options.current, parts.options.pixelRadians);
    parts.uniforms.bottom.x = parts.bottom ? 1.0F : 0.0F;
    parts.food.update(frame.food);
    parts.setUniforms();
    parts.school.update(frame.fish);
    parts.school.bindRecords();
    if (parts.bottom)
        parts.bottom->reef.stir(parts.school.fishInRecords(), parts.school.fraction());
    parts.light.update(frame.timeSeconds, frame.eyePositionMetres);
    parts.light.shade().updateFish(parts.school);
}

// The order of a view: computation, opaque bodies and place, water, then all that is blended, in a
// fixed order, then the passes over the picture.
unsigned SceneRenderer::draw(const View& view) {
    assert(view.sizePixels.x > 0);
    assert(view.sizePixels.y > 0);
    assert(view.finer > 0);
    Parts& parts = *parts_;
    setView(parts.uniforms, view, parts.options.pixelRadians);
    parts.setUniforms();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const glm::vec3 eye(parts.uniforms.eyeAndTime);
    parts.light.bind();
    parts.light.drawShafts(eye, parts.uniforms.worldFromClip);
    parts.school.look(
        parts.uniforms.clipFromWorld,
        {glm::vec3(parts.uniforms.sharedEyeAndPixel), parts.uniforms.sharedEyeAndPixel.w});
    // All compute passes run before anything is drawn: a driver may have to wait when it switches
    // between the two.
    parts.cullPlace(view.finer);
    parts.picture.begin(drawnOf(view).size);
    parts.school.drawBodies();
    parts.drawSolids();
    parts.drawWater();
    parts.school.drawBlended();
    parts.food.draw();
    parts.drawSnow();
    return parts.picture.finish(view.finer > 1);
}

surface::SurfaceCounts SceneRenderer::fishCounts() const {
    return parts_->school.counts();
}

}  // namespace aquarama::scene
