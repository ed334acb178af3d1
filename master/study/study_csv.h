// SPDX-License-Identifier: Apache-2.0
// What the study and the chronicle write as CSV; draw_study.py makes their tables and the figure of
// it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "master/study/chronicle.h"
#include "master/study/study.h"

namespace aquarama::study {

// A line for each scenario, condition and seed; empty where a run has none of a quantity.
[[nodiscard]] std::string runsCsv(const StudyPlan& plan, const std::vector<Sample>& samples);

// A line an hour; the shares are of the routines that the fish followed.
[[nodiscard]] std::string hoursCsv(std::span<const Hour> hours);

// A line for each time that two fish overlapped, with what both were about as it began.
[[nodiscard]] std::string overlapsCsv(const OverlapLog& log,
                                      const world::World& world,
                                      std::span<const world::WorldSpecies> cast);

}  // namespace aquarama::study
