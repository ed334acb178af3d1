// SPDX-License-Identifier: Apache-2.0
// What several seeds tell together.
#pragma once

#include <vector>

#include "master/study/quantities.h"

namespace aquarama::study {

struct Estimate {
    double mean = 0;
    double standardError = 0;  // of the mean
    std::size_t seeds = 0;     // that have a value
};
[[nodiscard]] Estimate estimateOf(const std::vector<Figures>& runs, Quantity quantity);

// Of `with` over `without`, seed by seed: what seeds have in common falls out.
[[nodiscard]] Estimate differenceOf(const std::vector<Figures>& without,
                                    const std::vector<Figures>& with,
                                    Quantity quantity);

// More than chance would do in 95 of 100 studies.
[[nodiscard]] bool isClear(const Estimate& difference);

}  // namespace aquarama::study
