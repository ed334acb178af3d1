// SPDX-License-Identifier: Apache-2.0
#include "common/wall/eyes.h"

namespace aquarama::wall {

glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side) {
    const double half = rig.stereo.eyeSeparationMetres / 2;
    const double right = side == EyeSide::Between ? 0 : side == EyeSide::Left ? -half : half;
    return rig.sweetSpotMetres + glm::dvec3(right, 0, 0);
}

config::Stereo stereoOf(const config::Rig& rig, std::size_t channel) {
    const config::Display& display = rig.channels[channel].display;
    config::Stereo stereo = rig.stereo;
    stereo.mode = display.stereo.value_or(stereo.mode);
    stereo.swapEyes = display.swapEyes.value_or(stereo.swapEyes);
    return stereo;
}

}  // namespace aquarama::wall
