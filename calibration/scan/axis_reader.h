// SPDX-License-Identifier: Apache-2.0
// Reads the place of one channel along one axis, pixel by pixel of the camera.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "calibration/scan/axis_signals.h"

namespace aquarama::scan {

inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// A place along an axis and its standard deviation, in pixels of the channel.
struct Reading {
    float place = kUnknown;
    float sigma = kUnknown;
    // Whether a place was read: it is NaN otherwise.
    [[nodiscard]] bool isKnown() const { return place == place; }
};

// Immutable; for any thread. Refers to its signals and light.
class AxisReader {
  public:
    virtual ~AxisReader() = default;
    // From the pixel alone. Unknown where its bits leave a doubt.
    [[nodiscard]] virtual Reading read(std::size_t pixel) const = 0;
    // Near a place that the neighbours expect. Unknown where the pixel's own bits contradict it.
    [[nodiscard]] virtual Reading readNear(std::size_t pixel, float expected) const = 0;
    // Standard deviation of the linear light of middle tones.
    [[nodiscard]] virtual double noise() const = 0;
};

// `light`: of the channel's white, for each pixel of the camera; `owned`: the pixels of the
// channel. Signals and light outlive the reader.

// By phase, which gives the place within a period; stripes of half a period give the period.
[[nodiscard]] std::unique_ptr<AxisReader> makePhaseReader(const AxisSignals& signals,
                                                          const Plane& light,
                                                          const std::vector<std::size_t>& owned,
                                                          int pixelsOfAxis);
// By stripes alone: the place where blurred stripes look most like the pixel. Each column lies near
// the edge of one bit, whose slope gives the place more exactly than the side of the edge.
[[nodiscard]] std::unique_ptr<AxisReader> makeStripeReader(const AxisSignals& signals,
                                                           const Plane& light,
                                                           const std::vector<std::size_t>& owned,
                                                           int pixelsOfAxis);

}  // namespace aquarama::scan
