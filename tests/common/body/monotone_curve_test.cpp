// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gtest/gtest.h>

#include "common/body/spine.h"

namespace aquarama::body {
namespace {

TEST(MonotoneCurve, passesThroughItsTableAndHoldsOutsideOfIt) {
    const MonotoneCurve curve({0, 1, 3, 4}, {2, 5, 4, 4});
    EXPECT_FLOAT_EQ(curve.at(1), 5);
    EXPECT_FLOAT_EQ(curve.at(3), 4);
    EXPECT_FLOAT_EQ(curve.at(-1), 2);
    EXPECT_FLOAT_EQ(curve.at(9), 4);
}

TEST(MonotoneCurve, isExactOnAStraightLine) {
    const MonotoneCurve curve({0, 1, 3, 7}, {1, 3, 7, 15});
    for (float x = 0; x < 7; x += 0.25F) EXPECT_NEAR(curve.at(x), 1 + 2 * x, 1e-5F) << x;
}

TEST(MonotoneCurve, neverSwingsPastItsNeighbours) {
    const std::vector<float> x{0, 0.1F, 0.2F, 1, 1.1F};
    const std::vector<float> y{0, 0.9F, 1, 1, 0.1F};
    const MonotoneCurve curve(x, y);
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        for (int k = 0; k <= 20; ++k) {
            const float value = curve.at(x[i] + (x[i + 1] - x[i]) * static_cast<float>(k) / 20);
            EXPECT_GE(value, std::min(y[i], y[i + 1]) - 1e-6F);
            EXPECT_LE(value, std::max(y[i], y[i + 1]) + 1e-6F);
        }
    }
}

}  // namespace
}  // namespace aquarama::body
