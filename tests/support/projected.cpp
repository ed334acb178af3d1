// SPDX-License-Identifier: Apache-2.0
#include "tests/support/projected.h"

#include "common/wall/wall.h"

namespace aquarama::test {

Light projectedLight(const config::Rig& rig, std::size_t channel, wall::TestPattern pattern) {
    const wall::Wall wall(rig);
    const bool isAround = wall.screen().patternGround().isAround();
    const wall::WarpMap warp = wall.warp(channel);
    Light light = darkness(warp.sizePixels);
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
        const glm::dvec4 lit(warp.pointAndWeight[i]);
        if (lit.w <= 0) continue;
        light.rgb[i] = glm::vec3(static_cast<float>(
            lit.w * wall::patternLight(pattern, glm::dvec3(lit) - wall.patternOrigin(), isAround)));
    }
    return light;
}

Light directPanorama(const config::Rig& rig, wall::TestPattern pattern) {
    const wall::Wall wall(rig);
    const bool isAround = wall.screen().patternGround().isAround();
    Light light = darkness(rig.panoramaPixels);
    for (int y = 0; y < rig.panoramaPixels.y; ++y)
        for (int x = 0; x < rig.panoramaPixels.x; ++x) {
            const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(rig.panoramaPixels);
            if (const auto point = wall.screen().at(at))
                light.at(x, y) = glm::vec3(static_cast<float>(
                    wall::patternLight(pattern, *point - wall.patternOrigin(), isAround)));
        }
    return light;
}

}  // namespace aquarama::test
