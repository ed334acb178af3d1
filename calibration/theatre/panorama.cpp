// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "calibration/theatre/compose.h"
#include "common/wall/pinhole.h"
#include "common/wall/wall.h"

namespace aquarama {

Light composePanorama(const Rig& rig, std::span<const Light> channels) {
    std::vector<Pinhole> projectors;
    for (const Channel& channel : rig.channels) projectors.emplace_back(channel);
    Light panorama = darkness(rig.panoramaPixels);
    for (int y = 0; y < rig.panoramaPixels.y; ++y)
        for (int x = 0; x < rig.panoramaPixels.x; ++x) {
            const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(rig.panoramaPixels);
            const glm::dvec3 point = screenPointAt(rig.screen, at);
            for (std::size_t i = 0; i < projectors.size(); ++i) {
                const auto pixel = projectors[i].pixelOf(point);
                if (pixel && lightsInside(projectors[i], point))
                    panorama.at(x, y) += bilinear(channels[i], *pixel);
            }
        }
    return panorama;
}

}  // namespace aquarama
