// SPDX-License-Identifier: Apache-2.0
#include "master/study/quantities.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "common/base/hash.h"
#include "common/base/units.h"

namespace aquarama::study {

namespace {

// Pellets of a pinch.
constexpr std::uint32_t kPellets = 12;
// Stream of the seed for the places of pinches.
constexpr std::uint32_t kPinches = 701;

// A random place in the upper half of the water, away from its borders.
glm::vec3 placeOf(const place::Region& water, std::uint32_t hash) {
    const glm::vec3 share{
        signedUnitOf(hash), unitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
    return water.centre + water.halfExtent * share * 0.6F;
}

// Indexed by Quantity.
constexpr std::array<const char*, kQuantities> kKeys{
    "touches_per_fish_minute",
    "deep_touches_per_fish_minute",
    "overlap_share_percent",
    "bumps_per_fish_minute",
    "meals_per_try",
    "particles_per_fish_minute",
    "pursuit_seconds_per_particle",
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

// NaN where the whole is 0.
double share(double part, double whole) {
    return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

double count(std::uint64_t number) {
    return static_cast<double>(number);
}

constexpr double kRadiansOfPhase = 2 * std::numbers::pi / 65536;
constexpr int kInStepPhase = 65536 / 16;

motion::Action patternAt(const motion::MotionStates& states, std::size_t fish) {
    return patternOf(motion::actionOf(states.segment[fish]));
}

// Smallest difference of two phases, around the cycle: 16-bit subtraction wraps as phases do.
int phaseBetween(std::uint16_t a, std::uint16_t b) {
    return std::abs(static_cast<std::int16_t>(static_cast<std::uint16_t>(a - b)));
}

// Those of fish [first, last) that are not away.
std::vector<std::size_t> present(const fish::FishView& view, std::size_t first, std::size_t last) {
    std::vector<std::size_t> fish;
    for (std::size_t i = first; i < last; ++i)
        if (!view.shows(i, fish::kAway)) fish.push_back(i);
    return fish;
}

float distanceToNearest(const fish::FishView& view,
                        const std::vector<std::size_t>& all,
                        std::size_t one) {
    float nearest = std::numeric_limits<float>::max();
    for (const std::size_t other : all)
        if (other != one)
            nearest = std::min(nearest, glm::distance(view.position(one), view.position(other)));
    return nearest;
}

}  // namespace

void Feeding::before(world::World& world) {
    if (between_ == 0 || world.tick().value % between_ != 0) return;
    // The last pinch was not half eaten in time.
    if (waits_) ticks_ += between_;
    const place::Region& water = world.surroundings().obstacles.water;
    world.apply(
        world::DropFood{placeOf(water, hashOf(hashOf(seed_, kPinches), pinches_)), kPellets});
    ++pinches_;
    waits_ = true;
    // From here the new pinch is timed; particles eaten before do not count.
    thrownAt_ = world.tick().value;
    eatenBefore_ = eaten_;
}

void Feeding::after(const world::World& world, std::uint64_t particlesEaten) {
    assert(particlesEaten >= eaten_);
    eaten_ = particlesEaten;
    if (!waits_ || eaten_ - eatenBefore_ < kPellets / 2) return;
    ticks_ += world.tick().value - thrownAt_;
    waits_ = false;
}

double Feeding::meanSeconds() const {
    // The last pinch does not count while it waits.
    const std::uint32_t timed = pinches_ - (waits_ ? 1 : 0);
    if (timed == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(ticks_) / timed / static_cast<double>(kTicksPerSecond);
}

const char* keyOf(Quantity quantity) {
    return kKeys.at(static_cast<std::size_t>(quantity));
}

Figures figuresOf(const Diary& diary, double pinchSeconds) {
    const Tally& tally = diary.tally();
    const double fishMinutes = tally.fishTicks / kTicksPerMinute;
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
    set(Quantity::MealSeconds,
        share(count(tally.pursuitTicks) / kTicksPerSecond, count(tally.particles)));
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

SchoolFigures schoolFigures(const fish::FishView& view, std::size_t first, std::size_t last) {
    assert(first <= last);
    assert(last <= view.size());
    const std::vector<std::size_t> fish = present(view, first, last);
    SchoolFigures figures;
    if (fish.size() < 2) return figures;
    const float share = 1 / static_cast<float>(fish.size());
    // Means over the fish: each term is weighted by 1 / n.
    glm::vec3 middle{}, heading{}, momentum{};
    for (const std::size_t i : fish) middle += view.position(i) * share;
    for (const std::size_t i : fish) {
        const glm::vec3 from = view.position(i) - middle;
        const float distance = glm::length(from);
        heading += view.heading(i) * share;
        if (distance > 0) momentum += glm::cross(from / distance, view.heading(i)) * share;
        figures.radiusMetres += static_cast<double>(distance * distance * share);
        figures.nearestNeighbour +=
            static_cast<double>(distanceToNearest(view, fish, i) / view.fish[i].length * share);
    }
    figures.polarisation = static_cast<double>(glm::length(heading));
    figures.rotation = static_cast<double>(glm::length(momentum));
    figures.radiusMetres = std::sqrt(figures.radiusMetres);
    return figures;
}

Synchrony synchronyOf(const motion::MotionStates& states, std::size_t first, std::size_t last) {
    assert(first <= last);
    assert(last <= states.size());
    double sine = 0, cosine = 0;
    double alike = 0, inStep = 0;
    for (std::size_t i = first; i < last; ++i) {
        sine += std::sin(states.phase[i] * kRadiansOfPhase);
        cosine += std::cos(states.phase[i] * kRadiansOfPhase);
        for (std::size_t j = i + 1; j < last; ++j) {
            if (patternAt(states, i) != patternAt(states, j)) continue;
            ++alike;
            if (phaseBetween(states.phase[i], states.phase[j]) < kInStepPhase) ++inStep;
        }
    }
    const auto fish = static_cast<double>(last - first);
    if (fish < 2) return {};
    const double pairs = fish * (fish - 1) / 2;
    return {std::hypot(sine, cosine) / fish, alike / pairs, inStep / pairs};
}

}  // namespace aquarama::study
