// SPDX-License-Identifier: Apache-2.0
// How the skin of a species is painted: by a program of its own where there is one, else plainly in
// the colours of its file.
#pragma once

#include <string>

#include <glm/vec3.hpp>

namespace aquarama::config {
struct Species;
}

namespace aquarama::body {

struct FishSkin {
    std::string species;  // whose skin shader is render_node/shaders/skin_SPECIES.glsl
    // Linear Rec. 709.
    glm::vec3 back{}, flank{}, belly{};
};

[[nodiscard]] FishSkin skinOf(const config::Species& species);

}  // namespace aquarama::body
