// SPDX-License-Identifier: Apache-2.0
// A world for tests of hands before the wall.
#pragma once

#include <cstdint>

#include "tests/master/world/captured_fish.h"

namespace aquarama::world {

// Three dozen fish of two kinds before the eye, at ease.
inline WorldOptions fishAtEase(std::uint32_t seed) {
    WorldOptions options;
    options.seed = seed;
    options.scene.gathering = config::Gathering::None;
    options.scene.plankton = 0;
    options.scene.eye = {0, -6, 0};
    options.scene.water.centre = {0, -6, -4};
    options.scene.water.halfExtent = {5, 2, 4};
    for (const char* name : {"blue_tang", "butterflyfish"}) {
        WorldSpecies fish = capturedSpecies(test::castMember(name), 18);
        fish.habits = {};
        fish.habits.libidoPerSecond = 0;
        options.cast.push_back(fish);
    }
    return options;
}

}  // namespace aquarama::world
