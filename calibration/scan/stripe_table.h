// SPDX-License-Identifier: Apache-2.0
// What the stripes of a Gray code look like when they are blurred.
#pragma once

#include <span>
#include <vector>

#include "calibration/scan/axis_signals.h"

namespace aquarama::scan {

// All bits of a code along one axis of a channel's picture: 1 lit, -1 dark.
class StripeTable {
  public:
    // Samples `perPixel` places of each of the `pixels`. `blurPixels`: standard deviation.
    StripeTable(int pixels, const AxisCode& code, int perPixel, double blurPixels);
    // The bits at a sample. A sample past an end is that of the end.
    [[nodiscard]] std::span<const float> at(int sample) const;
    [[nodiscard]] std::span<const float> atPlace(float place) const {
        return at(static_cast<int>(place * static_cast<float>(perPixel_)));
    }
    [[nodiscard]] int perPixel() const { return perPixel_; }
    [[nodiscard]] int samples() const { return samples_; }

  private:
    int bits_, perPixel_, samples_;
    std::vector<float> values_;
};

}  // namespace aquarama::scan
