// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gtest/gtest.h>

#include "render_node/show/built_look.h"

namespace aquarama::show {
namespace {

TEST(MeasuredQuality, isTheFinestWithinTheBudget) {
    const auto cost = [](config::QualityTier tier) {
        return tier == config::QualityTier::Low      ? 0.001
               : tier == config::QualityTier::Medium ? 0.002
               : tier == config::QualityTier::High   ? 0.008
                                                     : 0.1;
    };
    EXPECT_EQ(finestWithin(0.0005, cost), config::QualityTier::Low)
        << "the lowest must do in any case";
    EXPECT_EQ(finestWithin(0.0019, cost), config::QualityTier::Low);
    EXPECT_EQ(finestWithin(0.002, cost), config::QualityTier::Medium);
    EXPECT_EQ(finestWithin(0.05, cost), config::QualityTier::High);
    EXPECT_EQ(finestWithin(1.0, cost), config::QualityTier::Ultra);
}

// A slow machine does not spend its start on what it will never show.
TEST(MeasuredQuality, triesNothingBeyondTheFirstThatIsTooSlow) {
    std::vector<config::QualityTier> tried;
    const auto cost = [&](config::QualityTier tier) {
        tried.push_back(tier);
        return tier == config::QualityTier::Low ? 0.0 : 1.0;
    };
    EXPECT_EQ(finestWithin(0.5, cost), config::QualityTier::Low);
    EXPECT_EQ(tried, (std::vector{config::QualityTier::Low, config::QualityTier::Medium}));
}

}  // namespace
}  // namespace aquarama::show
