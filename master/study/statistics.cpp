// SPDX-License-Identifier: Apache-2.0
#include "master/study/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aquarama::study {

namespace {

// Student's t, two-sided 95 %, for 1, 2 ... degrees of freedom; beyond, as for the last.
constexpr std::array kStudent{
    12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23, 2.20, 2.18, 2.16, 2.14, 2.13};

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
    if (difference.seeds < 2) return false;
    const double bound = kStudent.at(std::min(difference.seeds - 2, kStudent.size() - 1));
    return std::abs(difference.mean) > bound * difference.standardError;
}

}  // namespace aquarama::study
