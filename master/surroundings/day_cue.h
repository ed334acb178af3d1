// SPDX-License-Identifier: Apache-2.0
// A cue for the time of day, as from a theatre's desk: the scene goes to a time of day and keeps
// it, or goes back to that of its clock, which runs on meanwhile.
#pragma once

#include <cstdint>
#include <optional>

#include "common/base/units.h"

namespace aquarama::surroundings {

// From the tick at which it was given. Times of day are shares, 0 to 1 (1 excluded).
struct DayCue {
    std::optional<double> holds;  // that it goes to and keeps; nothing: the clock's
    Tick since;
    double way = 0;           // to there, in days; below 0: back
    std::uint64_t ticks = 0;  // that the way takes
};

// From one time of day to another, in days: forward as the sun goes, or back where that is less
// than a quarter of a day.
[[nodiscard]] double wayBetween(double from, double to);
// The time of day at a tick at which the clock has another.
[[nodiscard]] double timeOfDayAt(const DayCue& cue, double clock, Tick tick);
// Whether it is done, and the clock's time holds.
[[nodiscard]] bool isOver(const DayCue& cue, Tick tick);
// The hash with it folded in; the same where there is none.
[[nodiscard]] std::uint64_t foldedCue(std::uint64_t hash, const std::optional<DayCue>& cue);

}  // namespace aquarama::surroundings
