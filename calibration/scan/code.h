// SPDX-License-Identifier: Apache-2.0
// Columns or rows of a channel's picture from what its patterns look like at each of a camera's
// pixels.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "calibration/scan/decode.h"
#include "calibration/scan/frames.h"

namespace aquarama::scan {

inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Channels that were scanned by the same pictures. Where two of them light a pixel, neither owns
// it.
struct Round {
    static constexpr std::uint8_t kNobody = 255;
    std::uint64_t channels = 0;
    std::vector<std::uint8_t> owner;  // of each pixel: index of the channel that lights it
    Plane middle;                     // between all black and all lit
};

// One axis: which patterns name it, and how they are told apart.
struct AxisCode {
    int axis = 0;  // 0: columns, 1: rows
    int bits = 0;
    int finestPixels = 0;
    bool isPaired = false;  // each stripe pattern has an inverse
    bool hasPhase = false;
};

// What an axis' pictures add up to.
struct AxisSignals {
    AxisCode code;
    // For each pixel `bits` values: 1 where lit, -1 where dark, in 1 / kContrastUnit.
    static constexpr float kContrastUnit = 4096;
    std::vector<std::int16_t> contrast;
    // Of the four steps I: I0 - I2, I1 - I3, their sum, and I0 - I1 + I2 - I3, which is noise.
    Plane cosine, sine, sum, alternate;

    AxisSignals(AxisCode axisCode, std::size_t pixels);
    void add(const ScanFrame& frame,
             const Round& round,
             const std::vector<ChannelView>& views,
             WorkerPool& pool);

  private:
    void addStripes(const ScanFrame& frame,
                    const Round& round,
                    const std::vector<ChannelView>& views,
                    WorkerPool& pool);
    void addPhase(const ScanFrame& frame, WorkerPool& pool);
};

// What stripes look like when blurred, along one axis of a picture: 1 lit, -1 dark.
class StripeTable {
  public:
    StripeTable(int pixels, const AxisCode& code, int perPixel, double blurPixels);
    // All bits at a place; those past the ends are those of the ends.
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

struct Reading {
    float place = kUnknown;
    float sigma = kUnknown;
    [[nodiscard]] bool isKnown() const { return place == place; }
};

// The places of one channel along one axis.
class AxisReader {
  public:
    virtual ~AxisReader() = default;
    // From the pixel alone. Nothing is known where its bits leave a doubt.
    [[nodiscard]] virtual Reading read(std::size_t pixel) const = 0;
    // With a place that its neighbours expect; its own pictures must agree with it.
    [[nodiscard]] virtual Reading readNear(std::size_t pixel, float expected) const = 0;
    // Standard deviation of linear light in the middle tones.
    [[nodiscard]] virtual double noise() const = 0;
};
// `light`: of the channel's white; `owned`: its pixels. All outlive the reader.
[[nodiscard]] std::unique_ptr<AxisReader> makeAxisReader(const AxisSignals& signals,
                                                         const Plane& light,
                                                         const std::vector<std::size_t>& owned,
                                                         int pixelsOfAxis);

// How far the stripes of a bit lie from where the phase says, in pixels of the channel: something
// has moved between the two. Nothing where too few stripes are seen.
[[nodiscard]] std::optional<double> stripeShift(const AxisSignals& signals,
                                                int bit,
                                                int pixelsOfAxis,
                                                const ChannelView& view,
                                                const std::vector<std::size_t>& owned);

}  // namespace aquarama::scan
