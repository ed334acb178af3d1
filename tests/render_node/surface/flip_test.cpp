// SPDX-License-Identifier: Apache-2.0
// Our reading of FLIP, where the paper's definition can be worked out by hand.
#include "tests/support/flip.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace aquarama::test {
namespace {

constexpr glm::ivec2 kSize{48, 32};

Picture plain(std::uint16_t r, std::uint16_t g, std::uint16_t b) {
    Picture picture{kSize, 8, {}};
    for (int i = 0; i < kSize.x * kSize.y; ++i) picture.rgb.insert(picture.rgb.end(), {r, g, b});
    return picture;
}

Picture withADot(Picture picture, int side) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            std::fill_n(
                picture.rgb.begin() + 3 * ((12 + y) * kSize.x + 20 + x), 3, std::uint16_t{255});
    return picture;
}

TEST(Flip, picturesThatAreTheSameDoNotDiffer) {
    const Picture picture = withADot(plain(40, 90, 120), 5);
    EXPECT_EQ(meanFlip(picture, picture), 0.0);
}

// The paper normalises by the pair that differs most, green and blue.
TEST(Flip, greenAndBlueDifferMost) {
    EXPECT_NEAR(meanFlip(plain(0, 255, 0), plain(0, 0, 255)), 1.0, 1e-9);
}

// HyAB of 100 units of lightness: 100^0.7 = 25.12 of at most 41.27, beyond the knee at 0.4, is
// 0.95 + 0.05 (25.12 - 16.51) / (41.27 - 16.51) = 0.967.
TEST(Flip, blackAndWhiteDifferAsThePaperMapsThem) {
    EXPECT_NEAR(meanFlip(plain(0, 0, 0), plain(255, 255, 255)), 0.967, 1e-3);
}

TEST(Flip, isSymmetric) {
    const Picture a = withADot(plain(40, 90, 120), 5), b = withADot(plain(60, 80, 120), 2);
    EXPECT_NEAR(meanFlip(a, b), meanFlip(b, a), 1e-12);
}

// An edge or a point that appears is seen better than its colour alone would be.
TEST(Flip, featuresAreAmplified) {
    const Picture water = plain(20, 60, 90), dot = withADot(water, 2);
    const std::vector<double> all = flip(water, dot);
    const double most = *std::ranges::max_element(all);
    EXPECT_GT(most, 0.3);
    EXPECT_LT(all.front(), 0.01) << "far from the dot";
    EXPECT_GT(meanFlip(water, withADot(water, 6)), meanFlip(water, dot));
    // The same difference, but everywhere: no feature.
    const double slight = meanFlip(plain(100, 100, 100), plain(104, 104, 104));
    EXPECT_GT(slight, 0.0);
    EXPECT_LT(slight, 0.15);
}

}  // namespace
}  // namespace aquarama::test
