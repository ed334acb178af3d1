// SPDX-License-Identifier: Apache-2.0
// The grid's light, by its closed form.
#include "common/wall/pattern.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/base/units.h"

namespace aquarama::wall {
namespace {

glm::dvec3 towards(double azimuthDegrees, double elevationDegrees) {
    const double azimuth = azimuthDegrees * kRadiansPerDegree<double>;
    return {std::sin(azimuth),
            std::tan(elevationDegrees * kRadiansPerDegree<double>),
            -std::cos(azimuth)};
}

TEST(TestPattern, linesStandAtEveryFifthDegreeAndTheThirtiethAreBright) {
    EXPECT_NEAR(gridLight(towards(0, 2)), 1, 1e-9);
    EXPECT_NEAR(gridLight(towards(-30, 2)), 1, 1e-9);
    EXPECT_NEAR(gridLight(towards(35, 2)), kGridMinorLight, 1e-9);
    EXPECT_NEAR(gridLight(towards(7, 20)), kGridMinorLight, 1e-9);
    EXPECT_NEAR(gridLight(towards(7, 0)), 1, 1e-9);
    EXPECT_NEAR(gridLight(towards(7, 2)), 0, 1e-9);
}

TEST(TestPattern, aLineIsAGaussianOfItsSigma) {
    EXPECT_NEAR(
        gridLight(towards(10 + kGridSigmaDegrees, 2)), kGridMinorLight * std::exp(-0.5), 1e-9);
    EXPECT_NEAR(
        gridLight(towards(7, -10 - 2 * kGridSigmaDegrees)), kGridMinorLight * std::exp(-2), 1e-9);
}

TEST(TestPattern, onlyTheDirectionCounts) {
    EXPECT_NEAR(gridLight(3.7 * towards(10.05, 4.9)), gridLight(towards(10.05, 4.9)), 1e-12);
}

}  // namespace
}  // namespace aquarama::wall
