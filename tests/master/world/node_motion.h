// SPDX-License-Identifier: Apache-2.0
// The fish of a world as a node moves them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/school/school_motion.h"
#include "master/world/world.h"

namespace aquarama::world {

// `world` is made from these options.
inline std::shared_ptr<school::SchoolMotion> nodeMotion(const WorldOptions& options,
                                                        const World& world) {
    std::vector<school::Swimmers> swimmers;
    std::size_t next = 0;
    for (const WorldSpecies& species : options.cast) {
        const std::size_t first = std::exchange(next, next + species.fish);
        swimmers.push_back({species.tables, first, next});
    }
    return std::make_shared<school::SchoolMotion>(
        std::move(swimmers),
        std::vector(world.traits().begin(), world.traits().end()),
        world.surroundings().obstacles,
        options.scene.current);
}

// Of its fish, by species.
inline std::vector<school::RecordedRates> ratesOf(const WorldOptions& options) {
    std::vector<school::RecordedRates> rates;
    std::uint32_t next = 0;
    for (const WorldSpecies& species : options.cast) {
        const std::uint32_t first = std::exchange(next, next + species.fish);
        rates.push_back(school::recordedRates(*species.tables, first, next));
    }
    return rates;
}

}  // namespace aquarama::world
