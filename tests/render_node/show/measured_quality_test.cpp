// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/measured_quality.h"

#include <vector>

#include <gtest/gtest.h>

namespace aquarama {
namespace {

TEST(MeasuredQuality, isTheFinestWithinTheBudget) {
    const auto cost = [](QualityTier tier) {
        return tier == QualityTier::Low      ? 0.001
               : tier == QualityTier::Medium ? 0.002
               : tier == QualityTier::High   ? 0.008
                                             : 0.1;
    };
    EXPECT_EQ(finestWithin(0.0005, cost), QualityTier::Low) << "the lowest must do in any case";
    EXPECT_EQ(finestWithin(0.0019, cost), QualityTier::Low);
    EXPECT_EQ(finestWithin(0.002, cost), QualityTier::Medium);
    EXPECT_EQ(finestWithin(0.05, cost), QualityTier::High);
    EXPECT_EQ(finestWithin(1.0, cost), QualityTier::Ultra);
}

// A slow machine does not spend its start on what it will never show.
TEST(MeasuredQuality, triesNothingBeyondTheFirstThatIsTooSlow) {
    std::vector<QualityTier> tried;
    const auto cost = [&](QualityTier tier) {
        tried.push_back(tier);
        return tier == QualityTier::Low ? 0.0 : 1.0;
    };
    EXPECT_EQ(finestWithin(0.5, cost), QualityTier::Low);
    EXPECT_EQ(tried, (std::vector{QualityTier::Low, QualityTier::Medium}));
}

}  // namespace
}  // namespace aquarama
