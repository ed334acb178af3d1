// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/skin_programs.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "render_node/gl/program.h"

namespace aquarama::surface {

namespace {

constexpr std::string_view kPlain = "skin_plain.glsl";

std::string painterOf(const body::FishSkin& skin) {
    std::string file = "skin_" + skin.species + ".glsl";
    const auto files = gl::shaderNames();
    return std::ranges::find(files, file) == files.end() ? std::string(kPlain) : file;
}

gl::ProgramHandle painting(const std::string& vertices,
                           const std::string& fragments,
                           const body::FishSkin& skin,
                           glm::vec3 eye) {
    const std::string painter = painterOf(skin);
    const std::array replaced{gl::Replacement{kPlain, painter}};
    gl::ProgramHandle program = gl::makeProgram({vertices, fragments}, replaced);
    const std::array<glm::vec3, 3> colours{skin.back, skin.flank, skin.belly};
    // Which of them a painter does not look at, has no location.
    const auto at = [&](const char* name) { return glGetUniformLocation(program.name(), name); };
    glProgramUniform3fv(program.name(), at("eyeOfSpecies"), 1, &eye.x);
    glProgramUniform3fv(program.name(), at("groundColours"), 3, &colours[0].x);
    return program;
}

}  // namespace

SkinPrograms::SkinPrograms() : surface{gl::makeProgram({"fish.comp"})} {}

std::shared_ptr<const SkinPrograms> makeSkinPrograms() {
    return std::make_shared<const SkinPrograms>();
}

SkinPainter::SkinPainter(const body::FishSkin& skin, glm::vec3 eye)
    : nearBody{painting("fish.vert", "fish_body.frag", skin, eye)},
      farBody{painting("fish.vert", "fish_far.frag", skin, eye)},
      fins{painting("fish.vert", "fish_fin.frag", skin, eye)},
      fewBody{painting("fish_few.vert", "fish_far.frag", skin, eye)},
      fewFins{painting("fish_few.vert", "fish_fin.frag", skin, eye)},
      point{painting("fish_point.vert", "fish_far.frag", skin, eye)} {}

}  // namespace aquarama::surface
