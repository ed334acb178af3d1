// SPDX-License-Identifier: Apache-2.0
// The light in the sea at one instant: the tables of the water, the waves, their caustics on the
// sand and the shafts of light in the water. Every node computes the same textures.
#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "render_node/gl/handle.h"
#include "render_node/quality/quality.h"
#include "render_node/scene/sea_shade.h"
#include "render_node/scene/shaft_map.h"
#include "render_node/scene/water_textures.h"
#include "render_node/water/water_tables.h"
#include "render_node/water/waves.h"

namespace aquarama::scene {

// The options of the light; fixed for the life of a SeaLight.
struct SeaLightOptions {
    std::uint32_t seed = 1;
    config::WaterType water = config::WaterType::IB;
    LightQuality quality;
    // A flat surface without waves, for tests.
    bool calm = false;
};

// Owns its GL objects; construct, use and destroy it with the same context current. Call update()
// once for each frame, then drawShafts() and bind() for each view.
class SeaLight {
  public:
    explicit SeaLight(const SeaLightOptions& options)
        : SeaLight(options, waterTables(options.water)) {}
    // tables: those of options.water.
    SeaLight(const SeaLightOptions& options, WaterTables tables);

    // The water's own light: its grade is to be set before the frame's uniforms are read.
    [[nodiscard]] WaterTextures& water() { return water_; }

    // Draws waves and caustics, which all views share, and sets the eye's depth of the water.
    // Expects the frame's uniform block to be bound. Switches the depth test off.
    void update(double timeSeconds, glm::vec3 sharedEyeMetres);
    // Draws the map of shafts, but only the directions that this view reads. Expects the sea's
    // light to be updated.
    void drawShafts(glm::vec3 eyeMetres, const glm::mat4& worldFromClip) {
        shafts_.draw(eyeMetres, worldFromClip, causticLayers_, shade_);
    }
    // Binds block and textures to the units that water.glsl and what it includes name.
    void bind() const;

    // The shade that things in the water cast.
    [[nodiscard]] SeaShade& shade() { return shade_; }
    // For tests: sunlight by depth (array layers) and by direction.
    [[nodiscard]] const gl::Texture& causticLayers() const { return causticLayers_; }
    [[nodiscard]] const gl::Texture& shaftMap() const { return shafts_.texture(); }

  private:
    void drawWaves();
    void drawCaustics();

    LightQuality quality_;
    Sea sea_;
    WaterTextures water_;
    gl::Texture cloudTile_, waveTile_, rippleTile_, causticLayers_;
    gl::Framebuffer waveTarget_, rippleTarget_, causticTarget_;
    gl::ProgramHandle waveProgram_, causticProgram_;
    ShaftMap shafts_;
    gl::Buffer seaBlock_, causticIndices_;
    gl::VertexArray empty_, causticGrid_;
    int causticIndexCount_ = 0;
    SeaShade shade_;
};

}  // namespace aquarama::scene
