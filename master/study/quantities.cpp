// SPDX-License-Identifier: Apache-2.0
#include "master/study/quantities.h"

#include <algorithm>
#include <limits>

#include "common/units/ids.h"

namespace aquarama::study {

namespace {

constexpr double kTicksOfMinute = 60.0 * kTicksPerSecond;

constexpr std::array<QuantityInfo, kQuantities> kInfo{{
    {"touches_per_fish_minute", "overlaps that begin, a fish and minute", 3, ""},
    {"deep_touches_per_fish_minute", "of them deeper than a quarter of a body", 4, ""},
    {"overlap_share_percent", "time in another fish, %", 2, ""},
    {"bumps_per_fish_minute", "into rock, sand or surface, a fish and minute", 4, ""},
    {"meals_per_try", "particles eaten a target gone for", 3, ""},
    {"particles_per_fish_minute", "particles eaten a fish and minute", 3, ""},
    {"half_pinch_seconds", "until half a pinch is eaten, s", 2, ""},
    {"catches_per_rush", "prey caught a rush", 3, ""},
    {"same_segment_percent", "pairs of the school on one segment, %", 1, ""},
    {"in_step_percent", "pairs in step (same segment, a sixteenth of a beat), %", 2, ""},
    {"phase_resultant", "mean resultant length of the phases", 3, "0.12: 51 at random"},
    {"nearest_neighbour_lengths",
     "nearest neighbour, body lengths",
     2,
     "0.5-1.5 (Partridge 1980; Pitcher & Parrish 1993)"},
    {"polarisation", "polarisation", 2, "> 0.65 schooling (Tunstrom 2013)"},
    {"rotation", "rotation", 2, "> 0.65 milling (Tunstrom 2013)"},
    {"intention_changes_per_minute", "changes of intention, a fish and minute", 2, ""},
}};

double share(double part, double whole) {
    return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

double count(std::uint64_t number) {
    return static_cast<double>(number);
}

}  // namespace

const QuantityInfo& infoOf(Quantity quantity) {
    return kInfo.at(static_cast<std::size_t>(quantity));
}

Figures figuresOf(const Diary& diary, double pinchSeconds) {
    const Tally& tally = diary.tally();
    const double fishMinutes = tally.fishTicks / kTicksOfMinute;
    const std::vector<BodyOverlap> overlaps = diary.overlaps().all();
    const auto deep = std::ranges::count_if(
        overlaps, [](const BodyOverlap& overlap) { return overlap.deepest > kDeepShare; });
    Figures figures{};
    const auto set = [&](Quantity quantity, double value) {
        figures.at(static_cast<std::size_t>(quantity)) = value;
    };
    set(Quantity::Touches, share(2 * count(tally.touches), fishMinutes));
    set(Quantity::DeepTouches, share(2 * static_cast<double>(deep), fishMinutes));
    set(Quantity::OverlapShare, 100 * share(tally.overlapTicks, tally.fishTicks));
    set(Quantity::Bumps, share(count(tally.bumps), fishMinutes));
    set(Quantity::MealsPerTry, share(count(tally.particles), count(tally.tries)));
    set(Quantity::ParticlesPerMinute, share(count(tally.particles), fishMinutes));
    set(Quantity::PinchSeconds, pinchSeconds);
    set(Quantity::CatchesPerRush, share(count(tally.catches), count(tally.rushes)));
    set(Quantity::SameSegment, 100 * share(tally.sameSegment, count(tally.glances)));
    set(Quantity::InStep, 100 * share(tally.inStep, count(tally.glances)));
    set(Quantity::Resultant, share(tally.resultant, count(tally.glances)));
    set(Quantity::NearestNeighbour, share(tally.nearestNeighbour, count(tally.glances)));
    set(Quantity::Polarisation, share(tally.polarisation, count(tally.glances)));
    set(Quantity::Rotation, share(tally.rotation, count(tally.glances)));
    set(Quantity::Changes, share(count(tally.changes), fishMinutes));
    return figures;
}

}  // namespace aquarama::study
