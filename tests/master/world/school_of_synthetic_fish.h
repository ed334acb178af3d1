// SPDX-License-Identifier: Apache-2.0
// Worlds for tests: the school as on the wall, moved by a synthetic repertoire.
#pragma once

#include <memory>

#include "common/motion/motor.h"
#include "master/world/world.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama {

inline std::shared_ptr<const MotorTables> syntheticTables() {
    static const std::shared_ptr<const MotorTables> tables =
        makeMotorTables(syntheticRepertoire());
    return tables;
}

inline World syntheticWorld(std::uint32_t seed, std::uint32_t fish, unsigned threads = 1) {
    WorldOptions options;
    options.seed = seed;
    options.fishCount = fish;
    options.threads = threads;
    return {options, syntheticTables()};
}

}  // namespace aquarama
