// SPDX-License-Identifier: Apache-2.0
#include "master/study/statistics.h"

#include <cmath>

namespace aquarama {

namespace {

double valueOf(const Figures& figures, Quantity quantity) {
    return figures.at(static_cast<std::size_t>(quantity));
}

Estimate estimate(const std::vector<double>& values) {
    Estimate estimate{.seeds = values.size()};
    const auto count = static_cast<double>(values.size());
    for (const double value : values) estimate.mean += value / count;
    double squares = 0;
    for (const double value : values) squares += (value - estimate.mean) * (value - estimate.mean);
    if (values.size() > 1) estimate.standardError = std::sqrt(squares / (count - 1) / count);
    return estimate;
}

}  // namespace

Estimate estimateOf(const std::vector<Figures>& runs, Quantity quantity) {
    std::vector<double> values;
    for (const Figures& run : runs)
        if (const double value = valueOf(run, quantity); !std::isnan(value))
            values.push_back(value);
    return estimate(values);
}

Estimate differenceOf(const std::vector<Figures>& without,
                      const std::vector<Figures>& with,
                      Quantity quantity) {
    std::vector<double> values;
    for (std::size_t seed = 0; seed < with.size(); ++seed) {
        const double value = valueOf(with[seed], quantity) - valueOf(without[seed], quantity);
        if (!std::isnan(value)) values.push_back(value);
    }
    return estimate(values);
}

bool isClear(const Estimate& difference) {
    return difference.seeds > 1 && std::abs(difference.mean) > 2 * difference.standardError;
}

}  // namespace aquarama
