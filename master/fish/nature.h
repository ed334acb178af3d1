// SPDX-License-Identifier: Apache-2.0
// A species as its fish's minds use it: habits in single precision, names resolved to indices of
// the cast.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/config/habits.h"
#include "common/units/limits.h"

namespace aquarama::fish {

struct Nature {
    config::Role role = config::Role::Prey;
    std::uint8_t kind = 0;              // its own index in the cast
    std::uint32_t first = 0, last = 0;  // its fish are [first, last) of all
    std::uint64_t hunts = 0;            // a bit for each kind that it eats
    std::uint64_t huntedBy = 0;         // a bit for each kind that eats it
    std::uint64_t shadows = 0;          // a bit for each kind that it likes to follow
    float appetite = 4, digestion = 0.004F, libido = 0;
    float fearMetres = 1.6F, fearFrom = 0.25F, fearAlone = 0.6F;
    float slow = 1, medium = 2, fast = 3;  // body lengths a second, of its repertoire
    float visionBodyLengths = 14, smellBodyLengths = 16;
    float boxAhead = 1.2F, boxAside = 0.4F, boxUp = 0.35F;  // body lengths
    float persistence = 0.3F;
    config::Habits habits;  // all of it, as the file has it
};

}  // namespace aquarama::fish
