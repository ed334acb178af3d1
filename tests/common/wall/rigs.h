// SPDX-License-Identifier: Apache-2.0
// The rigs that the tests of the wall stand on.
#pragma once

#include <random>
#include <string>

#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama::wall {

inline config::Rig shippedRig(const std::string& name) {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
}

// A projector on the axis, straight ahead, 100 x 100 pixels, 45 degrees to each side, on a screen
// of radius 2 and height 3.
inline config::Rig axisRig() {
    config::Rig rig;
    rig.screen.radiusMetres = 2;
    rig.screen.arcRadians = 1.5;
    rig.screen.heightMetres = 3;
    rig.channels.resize(1);
    rig.channels[0].name = "only";
    rig.channels[0].sizePixels = {100, 100};
    rig.channels[0].projector.focalPixels = {50, 50};
    rig.channels[0].projector.principalPixels = {50, 50};
    return rig;
}

// Uniform numbers from the engine alone: the library's distributions differ between libraries.
class Dice {
  public:
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
    }

  private:
    std::mt19937 engine_{1998};
};

}  // namespace aquarama::wall
