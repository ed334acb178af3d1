// SPDX-License-Identifier: Apache-2.0
// The pictures of the fidelity report, as SVG.
#pragma once

#include <span>
#include <string>

#include "master/capture/fidelity/fidelity.h"
#include "master/capture/fidelity/segment_count.h"

namespace aquarama::fidelity {

// The way of the fish from above, each command in its colour; over it, thin, the replica's, laid
// over it anew at each command (solid) and only at the beginning (dashed).
[[nodiscard]] std::string drawWays(const Fidelity& fidelity);

// The same for several species, small and side by side.
[[nodiscard]] std::string drawWaysOfAll(std::span<const Fidelity> species);

// Error of the shape over time on a logarithmic scale, and the speeds of both below.
[[nodiscard]] std::string drawTimes(const Fidelity& fidelity);

// Errors against the number of segments, a line for each species and their median.
[[nodiscard]] std::string drawVocabularies(std::span<const SpeciesVocabularies> species);

}  // namespace aquarama::fidelity
