// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "common/place/place.h"

namespace aquarama::place {
namespace {

TEST(Angle, agreesWithTheLibraryAllAround) {
    for (int i = -1800; i <= 1800; ++i) {
        const double angle = i * 0.1 * 3.14159265358979 / 180;
        const auto x = static_cast<float>(3.7 * std::cos(angle));
        const auto y = static_cast<float>(3.7 * std::sin(angle));
        EXPECT_NEAR(angleOf(y, x), std::atan2(y, x), 2.5e-5F) << i;
    }
    EXPECT_EQ(angleOf(0, 0), 0);
}

TEST(Angle, aTurnFromAheadToTheLeftIsPositive) {
    const glm::vec3 forward{1, 0, 0};
    const glm::vec3 left{0, 0, -1};  // a fish's z is to its right
    EXPECT_NEAR(yawBetween(forward, left), kPi / 2, 1e-4F);
    EXPECT_NEAR(yawBetween(left, forward), -kPi / 2, 1e-4F);
    EXPECT_NEAR(yawBetween({1, 0.4F, 0}, {1, -0.4F, 0}), 0, 1e-4F) << "pitch is no turn";
}

}  // namespace
}  // namespace aquarama::place
