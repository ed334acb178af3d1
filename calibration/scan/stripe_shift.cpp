// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/stripe_shift.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/scan/least_squares.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

std::optional<double> stripeShift(const AxisSignals& signals,
                                  int bit,
                                  int pixelsOfAxis,
                                  const ChannelView& view,
                                  const std::vector<std::size_t>& owned) {
    constexpr double kReach = 5;
    constexpr int kLeastPixels = 500;
    // Distance between edges of this bit; the first edge is half of it from the picture's border.
    // The contrast is slope * (offset - shift) near a rising edge and the negative near a falling
    // one. Indirect light adds the same to both.
    const double apart = signals.code.finestPixels << (codeOf(signals, pixelsOfAxis).bits - bit);
    LeastSquares<3> fit;
    std::array<int, 2> count{};
    for (const std::size_t p : owned) {
        const double edges = double{view.place[p][signals.code.axis]} / apart - 0.5;
        const double nearest = std::round(edges), offset = (edges - nearest) * apart;
        if (!(std::abs(offset) < kReach)) continue;
        const auto falls = static_cast<std::size_t>(static_cast<int>(nearest) & 1);
        const double sign = falls == 0 ? 1 : -1;
        const float contrast = contrastsOf(signals, p)[static_cast<std::size_t>(bit)];
        fit.add({sign * offset, -sign, 1}, double{contrast});
        ++count.at(falls);
    }
    const auto found = fit.solve();
    if (std::min(count[0], count[1]) < kLeastPixels || !found) return std::nullopt;
    // A larger shift cannot be told from stripes that are not usable.
    constexpr double kMost = wall::kScanPeriodPixels / 2.0;
    return std::clamp((*found)[1] / std::max(1e-3, (*found)[0]), -kMost, kMost);
}

}  // namespace aquarama::scan
