// SPDX-License-Identifier: Apache-2.0
// Worlds for tests of grazing and of territories: scenes of config/scenes/routines.
#pragma once

#include <cstdint>
#include <string>

#include "tests/master/world/captured_fish.h"

namespace aquarama::world {

// The scene of a routine, whose fish neither mate nor do anything else than graze at ease.
inline WorldOptions optionsOfRoutine(const std::string& name, std::uint32_t seed) {
    WorldOptions options = optionsOfScene("routines/" + name, seed);
    for (std::size_t i = 0; i < options.cast.size(); ++i) {
        options.cast[i].homes = options.scene.cast[i].homes;
        options.cast[i].habits.libidoPerSecond = 0;
        if (options.cast[i].habits.graze) options.cast[i].habits.graze->share = 1;
    }
    return options;
}

}  // namespace aquarama::world
