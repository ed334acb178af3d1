// SPDX-License-Identifier: Apache-2.0
// From a species' file to what its fish's minds use.
#pragma once

#include <cstddef>
#include <vector>

#include "master/fish/gaits.h"
#include "master/fish/species_parameters.h"
#include "master/world/world.h"

namespace aquarama::world {

// Of cast[kind], whose fish are [first, last). Names that nobody of the cast bears are passed over.
[[nodiscard]] fish::SpeciesParameters makeSpeciesParameters(const std::vector<WorldSpecies>& cast,
                                                            std::size_t kind,
                                                            const fish::Gaits& gaits,
                                                            std::size_t first,
                                                            std::size_t last);

}  // namespace aquarama::world
