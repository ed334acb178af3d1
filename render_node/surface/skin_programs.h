// SPDX-License-Identifier: Apache-2.0
// The shaders that pose fish, which the species of a cast share, and those that paint and light a
// species.
#pragma once

#include <memory>

#include <glm/vec3.hpp>

#include "common/body/fish_skin.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/shader_text.h"

namespace aquarama::surface {

struct SkinPrograms {
    gl::ProgramHandle surface;      // fish.comp
    gl::Replacements replacements;  // of a tier: for the skin shaders
};
[[nodiscard]] std::shared_ptr<const SkinPrograms> makeSkinPrograms(
    gl::Replacements replacements = {});

// What draws the skin of one species: fish_body.frag near, fish_far.frag far and fish_fin.frag with
// its skin shader, shaders/skin_SPECIES.glsl, or plainly where there is none.
struct SkinShader {
    // eye: s, y and radius, body lengths.
    SkinShader(const body::FishSkin& skin, glm::vec3 eye, const gl::Replacements& replacements);

    gl::ProgramHandle nearBody, farBody, fins;
    gl::ProgramHandle fewBody, fewFins, point;  // with the vertex shaders of coarser levels

    // Far bodies have no level finer than 0.
    [[nodiscard]] unsigned bodyOf(int level) const {
        return level == 0 ? farBody.name() : nearBody.name();
    }
};

}  // namespace aquarama::surface
