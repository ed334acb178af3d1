// SPDX-License-Identifier: Apache-2.0
#include "master/study/quantities.h"

#include <algorithm>
#include <limits>

#include "common/units/ids.h"

namespace aquarama::study {

namespace {

constexpr double kTicksOfMinute = 60.0 * kTicksPerSecond;

constexpr std::array<const char*, kQuantities> kKeys{
    "touches_per_fish_minute",
    "deep_touches_per_fish_minute",
    "overlap_share_percent",
    "bumps_per_fish_minute",
    "meals_per_try",
    "particles_per_fish_minute",
    "half_pinch_seconds",
    "catches_per_rush",
    "same_segment_percent",
    "in_step_percent",
    "phase_resultant",
    "nearest_neighbour_lengths",
    "polarisation",
    "rotation",
    "intention_changes_per_minute",
};

double share(double part, double whole) {
    return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

double count(std::uint64_t number) {
    return static_cast<double>(number);
}

}  // namespace

const char* keyOf(Quantity quantity) {
    return kKeys.at(static_cast<std::size_t>(quantity));
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
