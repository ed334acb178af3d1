// SPDX-License-Identifier: Apache-2.0
// How many live: who was eaten is away for a while, then another of its species comes from afar in
// its place, so that no species dies out. It bears the same index and length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/ids.h"
#include "master/fish/species_parameters.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::world {

// What happened since tick 0.
struct WorldCounts {
    std::uint64_t meals = 0;    // particles of food that were eaten
    std::uint64_t catches = 0;  // fish that were
    std::uint64_t spawnings = 0;
    std::uint64_t returns = 0;  // others that came instead of those eaten
    friend bool operator==(const WorldCounts&, const WorldCounts&) = default;
};

struct Absence {
    std::uint32_t fish = 0;
    Tick until;
};

// With room for all fish that somebody hunts; in the order in which they were eaten.
[[nodiscard]] std::vector<Absence> makeAbsences(
    std::span<const fish::SpeciesParameters> speciesParameters);
// 20 to 60 seconds from now.
[[nodiscard]] Absence absenceFrom(std::uint32_t seed, std::uint32_t fish, Tick now);

// Where one comes into sight: of places in the water, clear of rocks and sand, one that is as far
// from the eye as the water reaches, or in the haze more than 12 m away.
[[nodiscard]] glm::vec3 arrivalPlace(const surroundings::Surroundings& surroundings,
                                     std::uint32_t fish,
                                     Tick tick);

}  // namespace aquarama::world
