// SPDX-License-Identifier: Apache-2.0
// Golden pictures: what software Mesa drew when somebody last looked and found it right, in
// tests/golden. AQUARAMA_UPDATE_GOLDEN=1 draws them anew: then look at each before you commit it.
#pragma once

#include <string>

#include "common/base/picture.h"

namespace aquarama::test {

// How far a picture may be from its golden one: absolute differences of 8-bit sRGB codes over all
// channels. Drivers and processors round differently along outlines, hence two figures.
struct GoldenLimits {
    double meanCodes = 0.35;
    double percentile999Codes = 24;
};

// How far two pictures of one size are apart, in the same measures.
struct CodeDifference {
    double meanCodes = 0;
    double percentile999Codes = 0;
    [[nodiscard]] bool within(const GoldenLimits& limits) const {
        return meanCodes <= limits.meanCodes && percentile999Codes <= limits.percentile999Codes;
    }
};
[[nodiscard]] CodeDifference codeDifference(const Picture& a, const Picture& b);

// Where the picture of this name is.
[[nodiscard]] std::string goldenPath(const std::string& name);

// Fails, and leaves NAME.actual.png and NAME.difference.png (8 times the difference) in the working
// directory's golden/, when the picture is not as tests/golden/NAME.png.
void expectGolden(const Picture& picture, const std::string& name, const GoldenLimits& limits = {});

}  // namespace aquarama::test
