// SPDX-License-Identifier: Apache-2.0
// Ranks, medians and quantiles; and the distortion of lenses.
#include "common/base/statistics.h"

#include <array>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/brown_lens.h"

namespace aquarama {
namespace {

TEST(Statistics, ranksAreThoseOfSortedValues) {
    std::vector<int> values{5, 1, 4, 2};
    EXPECT_EQ(valueAtRank(values, 0), 1);
    EXPECT_EQ(valueAtRank(values, 3), 5);
    EXPECT_EQ(median(values), 4);  // the upper middle one
    EXPECT_EQ(median(std::array{3.0, 9.0, 1.0}), 3.0);
}

TEST(Statistics, aQuantileOfNothingIsZero) {
    EXPECT_EQ(quantile(std::vector<float>{}, 0.5), 0.0F);
    EXPECT_EQ(quantile(std::vector<double>{4, 2, 3, 1, 5}, 0), 1.0);
    EXPECT_EQ(quantile(std::vector<double>{4, 2, 3, 1, 5}, 0.5), 3.0);
    EXPECT_EQ(quantile(std::vector<double>{4, 2, 3, 1, 5}, 1), 5.0);
}

TEST(BrownLens, theTangentOfAnImageIsTheTangent) {
    const BrownLens<double> lens{-0.05, 0.02, 0.01, 0.002, -0.003};
    for (const glm::dvec2 tangent : {glm::dvec2(0), glm::dvec2(0.5, -0.3), glm::dvec2(-0.6, 0.7)})
        EXPECT_LT(glm::distance(tangentOf(lens, imageOf(lens, tangent)), tangent), 1e-13);
}

TEST(BrownLens, theSlopeIsThatOfTheImage) {
    const BrownLens<double> lens{-0.05, 0.02, 0.01, 0.002, -0.003};
    constexpr double kStep = 1e-6;
    const glm::dvec2 at(0.4, -0.3);
    const glm::dmat2 slope = imageSlope(lens, at);
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec2 step(0);
        step[axis] = kStep;
        const glm::dvec2 found =
            (imageOf(lens, at + step) - imageOf(lens, at - step)) / (2 * kStep);
        EXPECT_LT(glm::distance(found, slope[axis]), 1e-8);
    }
}

// Two tangents have this image: 1 and one beyond the fold.
TEST(BrownLens, theTangentBeforeAFoldIsTaken) {
    const BrownLens<double> lens{.k1 = 0.5, .k2 = -0.3};
    EXPECT_NEAR(tangentOf(lens, {1.2, 0}).x, 1, 1e-12);
    EXPECT_LT(lens.growth(1.5), 0);
}

}  // namespace
}  // namespace aquarama
