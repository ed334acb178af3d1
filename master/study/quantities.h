// SPDX-License-Identifier: Apache-2.0
// What the study measures of a run, and what was published of it.
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

struct QuantityInfo {
    const char* key;        // in the CSV file
    const char* words;      // with the unit
    int digits;             // after the point
    const char* published;  // empty: nothing to compare with
};
[[nodiscard]] const QuantityInfo& infoOf(Quantity quantity);

// NaN where a run has none of it: a share of no tries, the seconds of a pinch that nobody threw.
using Figures = std::array<double, kQuantities>;

// pinchSeconds: until half of a pinch of pellets was eaten, mean of those thrown.
[[nodiscard]] Figures figuresOf(const Diary& diary, double pinchSeconds);

}  // namespace aquarama::study
