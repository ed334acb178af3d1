// SPDX-License-Identifier: Apache-2.0
// What reads places from stripes, part by part.
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "calibration/scan/axis_reader.h"
#include "calibration/scan/least_squares.h"
#include "calibration/scan/noise_curve.h"
#include "calibration/scan/stripe_shift.h"
#include "calibration/scan/stripe_table.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {
namespace {

constexpr int kPixels = 256;

// Signals of a camera that sees one pixel of the channel in each of its own, `shift` pixels off.
AxisSignals signalsOf(const AxisCode& code, double shift, double blurPixels) {
    AxisSignals signals(code, kPixels);
    const StripeTable table(kPixels, code, 8, blurPixels);
    for (int p = 0; p < kPixels; ++p) {
        const auto bits = table.atPlace(static_cast<float>(p + 0.5 - shift));
        for (std::size_t k = 0; k < bits.size(); ++k)
            signals.contrast[static_cast<std::size_t>(p) * bits.size() + k] =
                static_cast<std::int16_t>(AxisSignals::kContrastUnit * bits[k]);
    }
    return signals;
}

TEST(GrayCodeTest, NamesEachStripe) {
    const config::ScanPattern stripes{.kind = config::ScanPattern::Kind::GrayColumns,
                                      .finestPixels = 1};
    for (int pixel = 0; pixel < kPixels; ++pixel) {
        Bits bits{};
        for (std::uint8_t k = 0; k < 8; ++k) {
            config::ScanPattern pattern = stripes;
            pattern.step = k;
            bits.at(k) = wall::scanShare(pattern, pixel, kPixels) > 0.5 ? 1.0F : -1.0F;
        }
        EXPECT_EQ(stripeOf(bits, 8), pixel);
        bits.at(7) = -bits.at(7);
        EXPECT_EQ(stripeOf(bits, 8, 1U), pixel);
    }
}

TEST(StripeTableTest, IsSharpInTheMiddleOfAStripeAndUndecidedAtItsEdge) {
    const StripeTable table(kPixels, {.bits = 4, .finestPixels = 16}, 4, 1.0);
    EXPECT_NEAR(double{table.atPlace(64)[0]}, -1, 1e-3);
    EXPECT_NEAR(double{table.atPlace(192)[0]}, 1, 1e-3);
    EXPECT_LT(std::abs(table.atPlace(128)[0]), 0.2F);
    EXPECT_EQ(table.at(-5)[0], table.at(0)[0]);
}

TEST(NoiseCurveTest, FindsTheVarianceOfEachLightWithoutOutliers) {
    NoiseCurve curve(1);
    const auto addAll = [&] {
        for (int i = 0; i < 1000; ++i) {
            curve.add(0.1F, 1e-4F);
            curve.add(0.9F, i % 100 == 0 ? 1.0F : 4e-4F);
        }
    };
    addAll();
    curve.trim();
    addAll();
    curve.finish();
    EXPECT_NEAR(double{curve.variance(0.1F)}, 1e-4, 1e-6);
    EXPECT_NEAR(double{curve.variance(0.9F)}, 4e-4, 1e-6);
    EXPECT_EQ(curve.variance(2.0F), curve.variance(1.0F));
}

TEST(LeastSquaresTest, FindsAPlaneAndRefusesALine) {
    LeastSquares<3> plane, line;
    for (int i = 0; i < 10; ++i) {
        const double x = i % 4, y = i / 4.0;
        plane.add({1, x, y}, 2 + 3 * x - y);
        line.add({1, x, 2 * x}, x);
    }
    const auto found = plane.solve();
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found)[0], 2, 1e-9);
    EXPECT_NEAR((*found)[1], 3, 1e-9);
    EXPECT_NEAR((*found)[2], -1, 1e-9);
    EXPECT_FALSE(line.solve());
}

TEST(StripeReaderTest, ReadsPlacesBetweenPixels) {
    const AxisSignals signals = signalsOf({.bits = 7, .finestPixels = 2}, 0.25, 0.8);
    const Plane light(kPixels, 0.5F);
    std::vector<std::size_t> owned(kPixels);
    std::iota(owned.begin(), owned.end(), 0);
    const auto reader = makeStripeReader(signals, light, owned, kPixels);
    for (std::size_t p = 10; p < 246; ++p) {
        const Reading reading = reader->read(p);
        ASSERT_TRUE(reading.isKnown());
        EXPECT_NEAR(double{reading.place}, static_cast<double>(p) + 0.25, 0.35);  // of stripes of 2
        EXPECT_NEAR(double{reader->readNear(p, static_cast<float>(p) + 2).place},
                    double{reading.place},
                    0.1);
    }
}

TEST(StripeShiftTest, FindsHowFarStripesLieFromThePhase) {
    const AxisSignals signals = signalsOf({.bits = 3, .finestPixels = 32}, 1.5, 3);
    ChannelView view;
    std::vector<std::size_t> owned;
    for (int p = 0; p < kPixels; ++p) {
        view.place.emplace_back(static_cast<float>(p) + 0.5F, 0.0F);
        for (int i = 0; i < 200; ++i) owned.push_back(static_cast<std::size_t>(p));
    }
    const auto shift = stripeShift(signals, 1, kPixels, view, owned);
    ASSERT_TRUE(shift);
    EXPECT_NEAR(*shift, 1.5, 0.2);
    owned.resize(100);
    EXPECT_FALSE(stripeShift(signals, 1, kPixels, view, owned));
}

}  // namespace
}  // namespace aquarama::scan
