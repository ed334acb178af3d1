// SPDX-License-Identifier: Apache-2.0
// A species as its fish's minds use it: its habits, and names resolved to indices of the cast.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/config/species.h"
#include "common/units/limits.h"

namespace aquarama::fish {

struct SpeciesParameters {
    std::uint8_t kind = 0;                 // its own index in the cast
    std::uint32_t first = 0, last = 0;     // its fish are [first, last) of all
    std::uint64_t hunts = 0;               // a bit for each kind that it eats
    std::uint64_t huntedBy = 0;            // a bit for each kind that eats it
    std::uint64_t shadows = 0;             // a bit for each kind that it likes to follow
    float slow = 1, medium = 2, fast = 3;  // body lengths a second, of its repertoire
    config::Habits habits;
};

}  // namespace aquarama::fish
