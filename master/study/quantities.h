// SPDX-License-Identifier: Apache-2.0
// What the study measures of a run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "master/study/diary.h"

namespace aquarama::study {

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

}  // namespace aquarama::study
