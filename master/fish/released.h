// SPDX-License-Identifier: Apache-2.0
// Hunters that a cue has released: each is led before the wall, and hunts there as any other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"

namespace aquarama::fish {

// One that is on its way.
struct Released {
    std::uint32_t fish = 0;
    Tick since;
};

// All of a world. Owned by it, changed between thoughts.
struct ReleasedHunters {
    std::vector<Released> fish;
    glm::vec3 place{};  // that they come to, metres, world frame

    // Whether a fish, by its index, is on its way.
    [[nodiscard]] bool has(std::uint32_t number) const {
        return std::ranges::find(fish, number, &Released::fish) != fish.end();
    }
};

}  // namespace aquarama::fish
