// SPDX-License-Identifier: Apache-2.0
// Fish that were eaten, until their places are taken.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/units.h"
#include "master/fish/fish_view.h"

namespace aquarama::world {

// A fish that was eaten, and the tick at which its place is taken.
struct Absence {
    std::uint32_t fish = 0;
    Tick until;
};

// An empty list with room for all fish that some species hunts. It is kept in the order in which
// they were eaten.
[[nodiscard]] std::vector<Absence> makeAbsences(
    std::span<const fish::SpeciesParameters> speciesParameters);
// An absence that ends 20 to 60 seconds from now, drawn by the seed.
[[nodiscard]] Absence absenceFrom(std::uint32_t seed, std::uint32_t fish, Tick now);

}  // namespace aquarama::world
