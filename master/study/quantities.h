// SPDX-License-Identifier: Apache-2.0
// A visitor who feeds at regular times, with a watch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/motion/motion_state.h"
#include "master/fish/fish_view.h"
#include "master/study/chronicle.h"
#include "master/world/world.h"

namespace aquarama::study {

class Feeding {
  public:
    // Between pinches; 0: never feeds.
    Feeding(std::uint64_t ticksBetween, std::uint32_t seed) : between_(ticksBetween), seed_(seed) {}
    void before(world::World& world);  // each tick
    void after(const world::World& world, std::uint64_t particlesEaten);
    // Until half of a pinch was eaten; a pinch of which less was eaten counts with all its time.
    // NaN where none was thrown.
    [[nodiscard]] double meanSeconds() const;

  private:
    std::uint64_t between_;
    std::uint32_t seed_;
    std::uint32_t pinches_ = 0;
    std::uint64_t eaten_ = 0, eatenBefore_ = 0, thrownAt_ = 0;
    bool waits_ = false;  // for the half
    std::uint64_t ticks_ = 0;
};

// What the study measures of a run.

enum class Quantity : std::uint8_t {
    Touches,
    DeepTouches,
    OverlapShare,
    Bumps,
    MealsPerTry,
    ParticlesPerMinute,
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
inline constexpr std::size_t kQuantities = 15;

// Its column in the CSV file; draw_study.py knows the words for it.
[[nodiscard]] const char* keyOf(Quantity quantity);

// NaN where a run has none of it: a share of no tries, the seconds of a pinch that nobody threw.
using Figures = std::array<double, kQuantities>;

// pinchSeconds: until half of a pinch of pellets was eaten, mean of those thrown.
[[nodiscard]] Figures figuresOf(const Diary& diary, double pinchSeconds);

// How a group of fish holds together, as biologists measure it, and how alike its members beat.

// Of fish [first, last) that are there.
struct SchoolFigures {
    double nearestNeighbour = 0;  // mean distance, body lengths of the fish itself
    double polarisation = 0;      // length of the mean heading (Tunstrom et al. 2013)
    double rotation = 0;          // of the mean angular momentum about the group's middle (same)
    double radiusMetres = 0;      // root mean square distance from the group's middle
};
[[nodiscard]] SchoolFigures schoolFigures(const fish::FishView& view,
                                          std::size_t first,
                                          std::size_t last);

// Two are in step if they play one segment within a sixteenth of a cycle of each other.
struct Synchrony {
    double resultant = 0;    // mean resultant length of the phases; of n at random sqrt(pi / 4n)
    double sameSegment = 0;  // share of pairs that play the same segment
    double inStep = 0;       // share of pairs
};
[[nodiscard]] Synchrony synchronyOf(const motion::MotionStates& states,
                                    std::size_t first,
                                    std::size_t last);

}  // namespace aquarama::study
