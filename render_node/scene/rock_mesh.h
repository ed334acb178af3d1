// SPDX-License-Identifier: Apache-2.0
// A boulder and the places on it where corals grow.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "render_node/scene/mesh.h"

namespace aquarama {

struct Spot {
    glm::vec3 position{};
    glm::vec3 normal{};
};

// level 0 is the finest of four. The shape is the same at all levels, only coarser.
void addBoulder(Mesh& mesh, const Rock& rock, int level);

// Where larvae settle: upper, open places, spread by the golden angle. The same at all levels.
[[nodiscard]] std::vector<Spot> spotsOn(const Rock& rock, int count);

}  // namespace aquarama
