// SPDX-License-Identifier: Apache-2.0
// Corals, sponges, fans and anemones: each grows from a spot, by a seed.
#pragma once

#include <cstdint>

#include "render_node/scene/mesh.h"
#include "render_node/scene/rock_mesh.h"

namespace aquarama {

// Closed, broad surfaces, which want fine relief, apart from plates, twigs and tubes, which are too
// small for it.
struct ReefMesh {
    Mesh stone;
    Mesh growth;
};

// One of the kinds, by the seed and how level the spot is. level 0 is the finest of four.
void addCoral(ReefMesh& mesh, const Spot& spot, float sizeMetres, std::uint32_t seed, int level);

}  // namespace aquarama
