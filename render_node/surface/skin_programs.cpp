// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/skin_programs.h"

#include <array>

#include "render_node/gl/program.h"

namespace aquarama {

namespace {

// Uniforms of reef_skins.glsl.
constexpr GLint kPattern = 3, kEyeOfSpecies = 4, kGroundColours = 5;

}  // namespace

SkinPrograms::SkinPrograms()
    : surface{gl::makeProgram({"fish.comp"})},
      nearScad{gl::makeProgram({"fish.vert", "fish.frag"})},
      farScad{gl::makeProgram({"fish.vert", "fish_far.frag"})},
      scadFins{gl::makeProgram({"fish.vert", "fish_fin.frag"})},
      reefFish{gl::makeProgram({"fish.vert", "reef_fish.frag"})},
      reefFins{gl::makeProgram({"fish.vert", "reef_fish_fin.frag"})} {}

unsigned SkinPrograms::bodyOf(SkinPattern pattern, int level) const {
    if (pattern != SkinPattern::BigeyeScad) return reefFish.name();
    return level == 0 ? farScad.name() : nearScad.name();
}

unsigned SkinPrograms::finsOf(SkinPattern pattern) const {
    return pattern == SkinPattern::BigeyeScad ? scadFins.name() : reefFins.name();
}

void SkinPrograms::dress(unsigned program, const FishSkin& skin, glm::vec3 eye) const {
    if (program != reefFish.name() && program != reefFins.name()) return;
    const std::array<glm::vec3, 3> colours{skin.back, skin.flank, skin.belly};
    glUniform1ui(kPattern, static_cast<GLuint>(skin.pattern));
    glUniform3fv(kEyeOfSpecies, 1, &eye.x);
    glUniform3fv(kGroundColours, 3, &colours[0].x);
}

std::shared_ptr<const SkinPrograms> makeSkinPrograms() {
    return std::make_shared<const SkinPrograms>();
}

}  // namespace aquarama
