// SPDX-License-Identifier: Apache-2.0
// A chronicle as tables in Markdown.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "master/study/chronicle.h"

namespace aquarama::study {

// A line an hour.
[[nodiscard]] std::string hoursMarkdown(std::span<const Hour> hours);

// Overlaps by the pair of species, and by the pair of routines that they began in; the most first.
[[nodiscard]] std::string overlapsMarkdown(const OverlapLog& log,
                                           const world::World& world,
                                           std::span<const world::WorldSpecies> cast,
                                           double hours);

}  // namespace aquarama::study
