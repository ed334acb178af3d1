// SPDX-License-Identifier: Apache-2.0
// Figures of many values: their root mean square, their median and other quantiles.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <vector>

namespace aquarama {

// 0 where there are no values.
[[nodiscard]] inline double rootMeanSquare(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

// The value at a rank (0 is the least) of values in any order, which it reorders.
template <std::ranges::random_access_range Values>
[[nodiscard]] auto valueAtRank(Values&& values, std::size_t rank) {
    assert(rank < std::ranges::size(values));
    const auto at = std::ranges::begin(values) + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(values, at);
    return *at;
}

// The median of values in any order, which it reorders: of an even number the upper middle one.
// There must be a value.
template <std::ranges::random_access_range Values>
[[nodiscard]] auto median(Values&& values) {
    return valueAtRank(values, std::ranges::size(values) / 2);
}

// The value below which this share (0 to 1) of the values lies; 0 where there are no values.
template <class Value>
[[nodiscard]] Value quantile(std::vector<Value> values, double share) {
    if (values.empty()) return {};
    return valueAtRank(values,
                       static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

}  // namespace aquarama
