// SPDX-License-Identifier: Apache-2.0
// The measures of a run in the study: a simulated visitor who feeds, the quantities and their
// names, and the figures of a school.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/motion/motion_state.h"
#include "master/fish/fish_view.h"
#include "master/study/diary.h"
#include "master/world/world.h"

namespace aquarama::study {

// A visitor who drops a pinch of pellets at regular times and measures how fast it is eaten.
class Feeding {
  public:
    // `ticksBetween` two pinches; 0: never feeds.
    Feeding(std::uint64_t ticksBetween, std::uint32_t seed) : between_(ticksBetween), seed_(seed) {}
    // Call it before each tick: drops a pinch when one is due.
    void before(world::World& world);
    // Call it after each tick, with the number of particles eaten since the beginning.
    void after(const world::World& world, std::uint64_t particlesEaten);
    // Mean time until half of a pinch was eaten. A pinch of which less was eaten counts with the
    // whole time to the next one. NaN where none was dropped.
    [[nodiscard]] double meanSeconds() const;

  private:
    std::uint64_t between_;
    std::uint32_t seed_;
    std::uint32_t pinches_ = 0;
    std::uint64_t eaten_ = 0, eatenBefore_ = 0, thrownAt_ = 0;
    // Whether half of the last pinch is still uneaten.
    bool waits_ = false;
    std::uint64_t ticks_ = 0;
};

// The quantities of a run. Those that are rates are for each fish and minute; overlaps count for
// both fish.
enum class Quantity : std::uint8_t {
    Touches,
    DeepTouches,
    OverlapShare,
    Bumps,
    MealsPerTry,
    ParticlesPerMinute,
    MealSeconds,
    PinchSeconds,
    CatchesPerRush,
    SameSegment,
    InStep,
    Resultant,
    NearestNeighbour,
    Polarisation,
    Rotation,
    Changes,
};
inline constexpr std::size_t kQuantities = 16;

// Name of its column in the CSV file; draw_study.py has the words for it.
[[nodiscard]] const char* keyOf(Quantity quantity);

// Values of one run, indexed by Quantity. NaN where a run has no value, such as a share of no
// tries.
using Figures = std::array<double, kQuantities>;

// `pinchSeconds` is Feeding::meanSeconds().
[[nodiscard]] Figures figuresOf(const Diary& diary, double pinchSeconds);

// How a group of fish holds together, as biologists measure it, and how synchronously its fish
// beat.

// Figures of those of fish [first, last) that are there; all 0 for fewer than two.
struct SchoolFigures {
    // Mean distance to the nearest neighbour, in body lengths of the fish itself.
    double nearestNeighbour = 0;
    // Length of the mean heading, 0 to 1 (Tunstrom et al. 2013).
    double polarisation = 0;
    // Length of the mean angular momentum about the group's middle, 0 to 1 (same).
    double rotation = 0;
    // Root mean square distance from the group's middle.
    double radiusMetres = 0;
};
// O(fish^2).
[[nodiscard]] SchoolFigures schoolFigures(const fish::FishView& view,
                                          std::size_t first,
                                          std::size_t last);

// Synchrony of tail beats. Two fish are in step if they play the same segment within a sixteenth of
// a cycle of each other.
struct Synchrony {
    // Mean resultant length of the phases, 0 to 1; for n random phases about sqrt(pi / 4n).
    double resultant = 0;
    // Share of pairs that play the same segment.
    double sameSegment = 0;
    // Share of pairs that are in step.
    double inStep = 0;
};
// The figures of all fish [first, last), whether away or not. O(fish^2).
[[nodiscard]] Synchrony synchronyOf(const motion::MotionStates& states,
                                    std::size_t first,
                                    std::size_t last);

}  // namespace aquarama::study
