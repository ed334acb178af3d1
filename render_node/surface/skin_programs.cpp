// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/skin_programs.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "render_node/gl/program.h"

namespace aquarama::surface {

namespace {

constexpr const char* kPlain = "skin_plain.glsl";

std::string skinShaderOf(const body::FishSkin& skin) {
    std::string file = "skin_" + skin.species + ".glsl";
    const auto files = gl::shaderNames();
    return std::ranges::find(files, file) == files.end() ? std::string(kPlain) : file;
}

gl::ProgramHandle skinProgram(const std::string& vertices,
                              const std::string& fragments,
                              const body::FishSkin& skin,
                              glm::vec3 eye,
                              gl::Replacements replacements) {
    replacements.push_back({kPlain, skinShaderOf(skin)});
    gl::ProgramHandle program = gl::makeProgram({vertices, fragments}, replacements);
    const std::array<glm::vec3, 3> colours{skin.back, skin.flank, skin.belly};
    // Which of them a skin shader does not look at, has no location.
    const auto at = [&](const char* name) { return glGetUniformLocation(program.name(), name); };
    glProgramUniform3fv(program.name(), at("eyeOfSpecies"), 1, &eye.x);
    glProgramUniform3fv(program.name(), at("groundColours"), 3, &colours[0].x);
    return program;
}

}  // namespace

std::shared_ptr<const SkinPrograms> makeSkinPrograms(gl::Replacements replacements) {
    return std::make_shared<const SkinPrograms>(
        SkinPrograms{gl::makeProgram({"fish.comp"}), std::move(replacements)});
}

SkinShader::SkinShader(const body::FishSkin& skin,
                       glm::vec3 eye,
                       const gl::Replacements& replacements)
    : nearBody{skinProgram("fish.vert", "fish_body.frag", skin, eye, replacements)},
      farBody{skinProgram("fish.vert", "fish_far.frag", skin, eye, replacements)},
      fins{skinProgram("fish.vert", "fish_fin.frag", skin, eye, replacements)},
      fewBody{skinProgram("fish_few.vert", "fish_far.frag", skin, eye, replacements)},
      fewFins{skinProgram("fish_few.vert", "fish_fin.frag", skin, eye, replacements)},
      point{skinProgram("fish_point.vert", "fish_far.frag", skin, eye, replacements)} {}

}  // namespace aquarama::surface
