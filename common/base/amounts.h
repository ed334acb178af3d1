// SPDX-License-Identifier: Apache-2.0
// Amounts in sentences: times, durations and sizes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <spdlog/fmt/fmt.h>

#include "common/base/units.h"

namespace aquarama {

// Of a world since its tick 0: "1:02:03".
[[nodiscard]] inline std::string timeOf(Tick tick) {
    const auto seconds =
        static_cast<std::uint64_t>(static_cast<double>(tick.value) / kTicksPerSecond);
    return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

// "2 s", "3 min", "15 h".
[[nodiscard]] inline std::string durationOf(double seconds) {
    constexpr double kMinute = 60, kHour = 3600, kMost = 2;
    if (seconds < kMost * kMinute) return fmt::format("{:.0f} s", seconds);
    if (seconds < kMost * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
    return fmt::format("{:.0f} h", seconds / kHour);
}

// In decimal units: "0 kB", "12 MB", "1.4 GB".
[[nodiscard]] inline std::string sizeOf(std::uint64_t bytes) {
    constexpr double kThousand = 1000, kFew = 10;
    constexpr std::array kUnits{"kB", "MB", "GB", "TB"};
    double amount = static_cast<double>(bytes) / kThousand;
    std::size_t unit = 0;
    for (; amount >= kThousand && unit + 1 < kUnits.size(); ++unit) amount /= kThousand;
    const bool isLarge = unit >= 2 && amount < kFew;
    return fmt::format("{:.{}f} {}", amount, isLarge ? 1 : 0, kUnits.at(unit));
}

}  // namespace aquarama
