// SPDX-License-Identifier: Apache-2.0
// What neighbours share adds up to one, everywhere, without an edge.
#include <gtest/gtest.h>

#include "rigs.h"

namespace aquarama::wall {
namespace {

class BlendOfRig : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, BlendOfRig, testing::Values("theatre", "touring", "desk"));

TEST_P(BlendOfRig, theSharesOfEveryPointOfTheScreenSumToOne) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    Dice dice;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 point =
            wall.screen().at({dice.between(0.001, 0.999), dice.between(0.001, 0.999)}).value();
        double sum = 0;
        for (std::size_t c = 0; c < rig.channels.size(); ++c) {
            const double weight = wall.weight(c, point);
            EXPECT_GE(weight, 0);
            sum += weight;
        }
        ASSERT_NEAR(sum, 1, 1e-6) << point.x << " " << point.y << " " << point.z;
    }
}

TEST_P(BlendOfRig, aShareFadesToNothingAtThePicturesBorderInsideAnOverlap) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    const config::Channel& left = rig.channels[0];
    for (int tenth = 1; tenth < 10; ++tenth) {
        const glm::dvec2 pixel(left.sizePixels.x - 1e-6, 0.1 * tenth * left.sizePixels.y);
        const auto border = wall.channel(0).pointOf(pixel, 0);
        ASSERT_TRUE(border);
        EXPECT_LT(wall.weight(0, *border), 1e-9);
        EXPECT_NEAR(wall.weight(1, *border), 1, 1e-9);
    }
}

// C1: as the step along the screen halves, so does the largest change of slope. At a kink it would
// stay what it is.
TEST_P(BlendOfRig, aShareHasNoKinkAlongTheScreen) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    const auto largestBend = [&](int steps) {
        const double step = 1.0 / steps;
        double largest = 0;
        for (int i = 2; i + 2 < steps; ++i) {
            const auto weight = [&](int at) {
                return wall.weight(1, wall.screen().at({at * step, 0.37}).value());
            };
            const double slopeBefore = (weight(i) - weight(i - 1)) / step;
            const double slopeAfter = (weight(i + 1) - weight(i)) / step;
            largest = std::max(largest, std::abs(slopeAfter - slopeBefore));
        }
        return largest;
    };
    const double coarse = largestBend(4000);
    const double fine = largestBend(8000);
    EXPECT_LT(fine, 0.6 * coarse);
}

TEST_P(BlendOfRig, outsideAnOverlapOneProjectorGivesAll) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    EXPECT_EQ(wall.weight(1, wall.screen().at({0.5, 0.5}).value()), 1);
    EXPECT_EQ(wall.weight(0, wall.screen().at({0.5, 0.5}).value()), 0);
    EXPECT_EQ(wall.weight(0, wall.screen().at({0.1, 0.2}).value()), 1);
}

}  // namespace
}  // namespace aquarama::wall
