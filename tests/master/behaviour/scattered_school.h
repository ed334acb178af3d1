// SPDX-License-Identifier: Apache-2.0
// Schools for tests: fish strewn through a region by a hash, so that every run sees the same ones.
#pragma once

#include <cstdint>

#include "common/base/hash.h"
#include "common/place/place.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

inline glm::vec3 scatteredPoint(std::uint32_t hash) {
    return {signedUnitOf(hashOf(hash, 0)),
            signedUnitOf(hashOf(hash, 1)),
            signedUnitOf(hashOf(hash, 2))};
}

inline fish::FishView scatteredSchool(std::uint32_t seed,
                                      std::size_t fish,
                                      const place::Region& region) {
    fish::FishView view;
    view.resize(fish);
    for (std::size_t i = 0; i < fish; ++i) {
        const std::uint32_t hash = hashOf(seed, static_cast<std::uint32_t>(i));
        const glm::vec3 position = region.centre + scatteredPoint(hash) * region.halfExtent;
        const glm::vec3 heading = place::directionOf(scatteredPoint(~hash), {1, 0, 0});
        view.fish[i].position = position;
        view.fish[i].heading = heading;
        view.fish[i].speed = 0.4F;
        view.fish[i].length = 0.24F;
    }
    return view;
}

}  // namespace aquarama::behaviour
