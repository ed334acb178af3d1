// SPDX-License-Identifier: Apache-2.0
#include <glm/vec4.hpp>

#include "common/wall/blend.h"
#include "common/wall/wall.h"

namespace aquarama::wall {

WarpMap warpMap(const config::Rig& rig, std::size_t channel) {
    const Blend blend(rig);
    const glm::ivec2 size = rig.channels[channel].sizePixels;
    WarpMap map;
    map.sizePixels = size;
    map.pointAndWeight.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Ray ray = blend.projector(channel).ray({x + 0.5, y + 0.5});
            const auto point = screenHit(rig.screen, ray, kSpillMetres);
            map.pointAndWeight.push_back(point ? glm::vec4(*point, blend.weight(channel, *point))
                                               : glm::vec4(0));
        }
    return map;
}

}  // namespace aquarama::wall
