// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/sun.h"

#include <glm/geometric.hpp>

namespace aquarama {

glm::vec3 sunInWater() {
    return glm::normalize(glm::vec3{-0.27F, 0.82F, -0.51F});
}

}  // namespace aquarama
