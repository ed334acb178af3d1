// SPDX-License-Identifier: Apache-2.0
// The light in the sea at one instant: the tables of the water, the waves, their caustics on the
// sand and the shafts in the water. The same textures on every node.
#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "render_node/gl/handle.h"
#include "render_node/light/sea_shade.h"
#include "render_node/reef/quality.h"
#include "render_node/water/water_tables.h"
#include "render_node/water/waves.h"

namespace aquarama::scene {

struct SeaLightOptions {
    std::uint32_t seed = 1;
    config::WaterType water = config::WaterType::IB;
    LightQuality quality;
    bool calm = false;  // a surface without waves
};

class SeaLight {
  public:
    explicit SeaLight(const SeaLightOptions& options)
        : SeaLight(options, waterTables(options.water)) {}
    SeaLight(const SeaLightOptions& options, WaterTables tables);  // of options.water

    // For the frame's uniforms: Kd of the primaries, and the exposure of an eye there.
    [[nodiscard]] glm::vec4 kdAndExposure(glm::vec3 sharedEyeMetres) const;

    // What is the same for all views. Expects the frame's uniform block to be bound.
    void update(double timeSeconds, glm::vec3 sharedEyeMetres);
    // Only where the view looks.
    void drawShafts(glm::vec3 eyeMetres, const glm::mat4& worldFromClip);
    void bind() const;  // to the units that water.glsl names

    [[nodiscard]] SeaShade& shade() { return shade_; }
    [[nodiscard]] const gl::Texture& causticLayers() const { return causticLayers_; }
    [[nodiscard]] const gl::Texture& shaftMap() const { return shaftMap_; }

  private:
    void drawWaves();
    void drawCaustics();

    LightQuality quality_;
    Sea sea_;
    Inscatter inscatter_;
    float tableDepthMetres_;
    Table atEye_;
    glm::vec3 primariesKd_;
    gl::Texture direct_, inscatterTable_, openWater_, cloudTile_;
    gl::Texture waveTile_, rippleTile_, causticLayers_, shaftMap_;
    gl::Framebuffer waveTarget_, rippleTarget_, causticTarget_, shaftTarget_;
    gl::ProgramHandle waveProgram_, causticProgram_, shaftProgram_;
    gl::Buffer seaBlock_, causticIndices_;
    gl::VertexArray empty_, causticGrid_;
    int causticIndexCount_ = 0;
    SeaShade shade_;
};

}  // namespace aquarama::scene
