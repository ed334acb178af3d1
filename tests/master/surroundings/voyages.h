// SPDX-License-Identifier: Apache-2.0
// Submarines in the scenes that are shipped, and hands that do not know what they want.
#pragma once

#include <cstdint>
#include <string>

#include "common/base/hash.h"
#include "common/config/scene.h"
#include "common/place/place.h"
#include "master/surroundings/pilot.h"

namespace aquarama::surroundings {

inline config::Scene shippedScene(const std::string& name) {
    return config::readScene(AQUARAMA_SOURCE_DIR "/config/scenes/" + name + ".txtpb");
}

inline Voyage voyageIn(const config::Scene& scene, std::uint32_t seed = 1) {
    return voyageOf(scene, seed, {scene.water.centre, scene.water.halfExtent});
}

// Another whim every second or so; full deflections are common.
inline Steering whim(std::uint32_t seed, std::uint64_t tick) {
    const auto second = static_cast<std::uint32_t>(tick / 45);
    const auto axis = [&](std::uint32_t stream) {
        const float desired = 2 * signedUnitOf(hashOf(hashOf(seed, stream), second));
        return static_cast<std::int8_t>(desired > 1 ? 127 : desired < -1 ? -127 : 127 * desired);
    };
    return {axis(1), axis(2), axis(3), axis(4), axis(5)};
}

}  // namespace aquarama::surroundings
