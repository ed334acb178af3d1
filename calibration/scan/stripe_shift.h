// SPDX-License-Identifier: Apache-2.0
// Finds movement between the stripe pictures and the phase pictures of a scan.
#pragma once

#include <optional>
#include <vector>

#include "calibration/scan/axis_signals.h"

namespace aquarama::scan {

// The distance of a bit's stripes from where the phase says that they are, in pixels of the channel
// (limited to half a period): something has moved between the pictures. Nothing where too few
// stripes are seen. `owned`: the pixels of the channel.
[[nodiscard]] std::optional<double> stripeShift(const AxisSignals& signals,
                                                int bit,
                                                int pixelsOfAxis,
                                                const ChannelView& view,
                                                const std::vector<std::size_t>& owned);

}  // namespace aquarama::scan
