// SPDX-License-Identifier: Apache-2.0
// Sums of many errors in one number.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace aquarama {

// The root of the mean of squares; 0 for an empty list, as the others.
[[nodiscard]] inline double rootMeanSquare(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

// A quantile of values in any order; share 0.5 is the median.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at =
        values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

}  // namespace aquarama
