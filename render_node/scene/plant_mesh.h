// SPDX-License-Identifier: Apache-2.0
// The shape of a plant, once for all of its kind: drawn many times, each turned, leaning and of its
// own height.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>

#include "common/place/place.h"

namespace aquarama {

// 24 bytes, as plant.vert reads them.
struct PlantVertex {
    glm::vec4 offsetAndShare{};    // from the stem, metres; w: share of the plant's height
    glm::i8vec4 normalAndBlade{};  // w: 0 on the stem to 127 at a blade's tip
    glm::u8vec4 albedo{};          // w: openness to light
};
static_assert(sizeof(PlantVertex) == 24);

struct PlantMesh {
    std::vector<PlantVertex> vertices;
    std::vector<std::uint16_t> indices;
};

// level 0 is the finest of three. Coarser ones have fewer, broader blades, so that a stand stays
// as dense.
[[nodiscard]] PlantMesh growPlant(PlantKind kind, int level);

}  // namespace aquarama
