// SPDX-License-Identifier: Apache-2.0
// What the fidelity command writes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "master/capture/fidelity/fidelity.h"
#include "master/capture/fidelity/segment_count.h"

namespace aquarama::fidelity {

// One page with a section for each species: ways, errors over time, tables.
[[nodiscard]] std::string fidelityPage(std::span<const Fidelity> species,
                                       std::span<const SpeciesVocabularies> vocabularies,
                                       std::uint64_t seed);

// A line for each command, and for each species one of the whole script, "open_loop".
[[nodiscard]] std::string fidelityCsv(std::span<const Fidelity> species);

// The tables of docs/fidelity.md: species by species, and command by command over all of them.
[[nodiscard]] std::string fidelityMarkdown(std::span<const Fidelity> species);

}  // namespace aquarama::fidelity
