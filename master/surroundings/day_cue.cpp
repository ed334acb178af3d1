// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/day_cue.h"

#include "common/base/digest.h"

namespace aquarama::surroundings {

namespace {

constexpr double kMostBack = 0.25;

// A time of day between -1 and 2, within one day.
double withinDay(double time) {
    return time < 0 ? time + 1 : time >= 1 ? time - 1 : time;
}

}  // namespace

double wayBetween(double from, double to) {
    const double forward = withinDay(to - from);
    return 1 - forward < kMostBack ? forward - 1 : forward;
}

// Begins and ends gently.
double timeOfDayAt(const DayCue& cue, double clock, Tick tick) {
    const double goal = cue.holds.value_or(clock);
    const std::uint64_t passed = tick.value - cue.since.value;
    if (passed >= cue.ticks) return goal;
    const double share = static_cast<double>(passed) / static_cast<double>(cue.ticks);
    const double left = 1 - share * share * (3 - 2 * share);
    return withinDay(goal - cue.way * left);
}

bool isOver(const DayCue& cue, Tick tick) {
    return !cue.holds && tick.value - cue.since.value >= cue.ticks;
}

std::uint64_t foldedCue(std::uint64_t hash, const std::optional<DayCue>& cue) {
    if (!cue) return hash;
    hash = foldedOne(foldedOne(hash, cue->since.value), cue->ticks);
    return foldedOne(foldedOne(hash, cue->way), cue->holds.value_or(-1));
}

}  // namespace aquarama::surroundings
