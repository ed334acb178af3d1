// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/stripe_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

// A Gaussian kernel whose sum is one.
std::vector<float> gaussOf(double deviation) {
    const int reach = static_cast<int>(std::ceil(3 * deviation));
    std::vector<float> kernel;
    for (int i = -reach; i <= reach; ++i)
        kernel.push_back(static_cast<float>(std::exp(-0.5 * std::pow(i / deviation, 2))));
    const float whole = std::accumulate(kernel.begin(), kernel.end(), 0.0F);
    for (float& weight : kernel) weight /= whole;
    return kernel;
}

}  // namespace

StripeTable::StripeTable(int pixels, const AxisCode& code, int perPixel, double blurPixels)
    : bits_{code.bits}, perPixel_{perPixel}, samples_{pixels * perPixel} {
    const std::vector<float> kernel = gaussOf(blurPixels * perPixel);
    const int reach = static_cast<int>(kernel.size()) / 2;
    values_.resize(static_cast<std::size_t>(samples_ * bits_));
    for (int k = 0; k < bits_; ++k) {
        const config::ScanPattern stripes{
            .kind = config::ScanPattern::Kind::GrayColumns,
            .step = static_cast<std::uint8_t>(k),
            .finestPixels = static_cast<std::uint16_t>(code.finestPixels)};
        std::vector<float> sharp;
        for (int i = -reach; i < samples_ + reach; ++i) {
            const int pixel = std::clamp(i, 0, samples_ - 1) / perPixel;
            sharp.push_back(static_cast<float>(2 * wall::scanShare(stripes, pixel, pixels) - 1));
        }
        for (int i = 0; i < samples_; ++i)
            values_[static_cast<std::size_t>(i * bits_ + k)] =
                std::inner_product(kernel.begin(), kernel.end(), sharp.begin() + i, 0.0F);
    }
}

std::span<const float> StripeTable::at(int sample) const {
    const int inside = std::clamp(sample, 0, samples_ - 1);
    return {&values_[static_cast<std::size_t>(inside * bits_)], static_cast<std::size_t>(bits_)};
}

}  // namespace aquarama::scan
