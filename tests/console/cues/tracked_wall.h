// SPDX-License-Identifier: Apache-2.0
// A wall with a tracker, for tests.
#pragma once

#include "common/config/rig.h"

namespace aquarama::test {

// A flat wall of 4 x 2 m, 3 m before the viewer, and a tracker of hands on it.
inline config::Rig wallOfHands(const config::UdpAddress& listen) {
    config::Rig rig;
    rig.screen.shape = config::ScreenShape::Flat;
    rig.screen.widthMetres = 4;
    rig.screen.heightMetres = 2;
    rig.screen.distanceMetres = 3;
    rig.touch.emplace();
    rig.touch->listen = listen;
    rig.touch->from = {"127.0.0.1"};
    rig.touch->topLeft = {-2, 1, -3};
    rig.touch->topRight = {2, 1, -3};
    rig.touch->bottomLeft = {-2, -1, -3};
    return rig;
}

}  // namespace aquarama::test
