// SPDX-License-Identifier: Apache-2.0
// How the skin of a species is painted: by a program of its own where there is one, else plainly in
// the colours of its file.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace aquarama {

// render_node/shaders/fish_skin.glsl paints the scad, reef_skins.glsl the others.
enum class SkinPattern : std::uint32_t {
    BigeyeScad,
    Plain,
    Clownfish,
    MoorishIdol,
    BlueTang,
    Parrotfish,
    Trumpetfish,
    BlacktipReefShark
};

struct FishSkin {
    SkinPattern pattern = SkinPattern::BigeyeScad;
    // Of a plain skin: linear Rec. 709.
    glm::vec3 back{}, flank{}, belly{};
};

struct Species;
[[nodiscard]] FishSkin skinOf(const Species& species);

}  // namespace aquarama
