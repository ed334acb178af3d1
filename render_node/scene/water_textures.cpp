// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/water_textures.h"

#include <utility>

#include "common/place/place.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

WaterTextures::WaterTextures(config::WaterType type, WaterTables tables)
    : water_{seaWater(type)},
      inscatter_{std::move(tables.inscatter)},
      gradedDirect_{std::move(tables.direct)},
      eyeDepthMetres_{-place::kEyePosition.y},
      atEye_{inscatter_.atDepth(double{eyeDepthMetres_})},
      graded_{gradedDirect_.at(colourReturned_)},
      primariesKd_{primariesDownwelling(water_)},
      direct_{makeTexture(graded_)},
      inscatterTable_{makeVolume(atEye_)},
      openWater_{makeTexture(tables.openWater)} {}

void WaterTextures::grade(double colourReturned) {
    if (colourReturned_ == colourReturned) return;
    colourReturned_ = colourReturned;
    gradedDirect_.mixAt(colourReturned, graded_);
    refill(direct_, graded_);
    primariesKd_ = primariesDownwelling(water_, gradeOf(colourReturned));
}

void WaterTextures::dive(float eyeDepthMetres) {
    if (eyeDepthMetres_ == eyeDepthMetres) return;
    eyeDepthMetres_ = eyeDepthMetres;
    inscatter_.mixAtDepth(double{eyeDepthMetres}, atEye_);
    refill(inscatterTable_, atEye_);
}

void WaterTextures::bind() const {
    glBindTextureUnit(shaders::kDirectTableUnit, direct_.name());
    glBindTextureUnit(shaders::kInscatterTableUnit, inscatterTable_.name());
    glBindTextureUnit(shaders::kOpenWaterTableUnit, openWater_.name());
}

glm::vec4 WaterTextures::kdAndExposure(glm::vec3 sharedEyeMetres) const {
    return {primariesKd_, inscatter_.exposureAt(-double{sharedEyeMetres.y})};
}

}  // namespace aquarama::scene
