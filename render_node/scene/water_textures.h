// SPDX-License-Identifier: Apache-2.0
// The tables of the water as textures, for the depth of the eye and the colour that is given back.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/config/scene.h"
#include "render_node/gl/handle.h"
#include "render_node/water/water_tables.h"

namespace aquarama::scene {

// Owns its GL objects; construct, use and destroy it with the same context current. A table is
// mixed and uploaded only where what it depends on has changed.
class WaterTextures {
  public:
    // For the depth of a reef's eye, and no colour given back.
    WaterTextures(config::WaterType type, WaterTables tables);

    // Sets the share of colour that is given back (Grade), 0 to 1.
    void grade(double colourReturned);
    // Sets the depth of the shared eye, metres.
    void dive(float eyeDepthMetres);
    // Binds the textures to the units that water.glsl names.
    void bind() const;

    // For the frame's uniforms: Kd of the three primaries (xyz, 1/m), and the exposure at this eye
    // (w).
    [[nodiscard]] glm::vec4 kdAndExposure(glm::vec3 sharedEyeMetres) const;

  private:
    WaterSpectra water_;
    Inscatter inscatter_;
    GradedDirect gradedDirect_;
    float eyeDepthMetres_;
    double colourReturned_ = 0;
    Table atEye_, graded_;  // of inscatter_ and gradedDirect_, for these
    glm::vec3 primariesKd_;
    gl::Texture direct_, inscatterTable_, openWater_;
};

}  // namespace aquarama::scene
