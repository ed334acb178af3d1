// SPDX-License-Identifier: Apache-2.0
// What the pictures of one axis, columns or rows, add up to at each of a camera's pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "calibration/scan/decode.h"
#include "calibration/scan/frames.h"

namespace aquarama::scan {

// Channels that the same pictures scan. A pixel that two of them light belongs to neither.
struct Round {
    static constexpr std::uint8_t kNobody = 255;
    std::uint64_t channels = 0;
    std::vector<std::uint8_t> owner;  // of each pixel: index of the channel that lights it
    Plane middle;                     // the light half-way between all black and all lit
};

// The patterns that measure one axis.
struct AxisCode {
    int axis = 0;  // 0: columns, 1: rows
    int bits = 0;  // of the Gray code
    int finestPixels = 0;
    bool isPaired = false;  // each stripe pattern has an inverse
    bool hasPhase = false;
};

// Sums over the pictures of an axis, for each pixel of the camera.
struct AxisSignals {
    AxisCode code;
    // `bits` values for each pixel: kContrastUnit where lit, -kContrastUnit where dark.
    static constexpr float kContrastUnit = 4096;
    std::vector<std::int16_t> contrast;
    // Of the phase steps I0 to I3: I0 - I2, I1 - I3, the sum of all, and I0 - I1 + I2 - I3, which
    // is only noise.
    Plane cosine, sine, sum, alternate;

    AxisSignals(AxisCode axisCode, std::size_t pixels);
    // Adds a picture of this axis. `views` have the light of each channel's white.
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

inline constexpr int kMostBits = 16;  // of a Gray code
// The signal of each stripe pattern, by its bit.
using Bits = std::array<float, kMostBits>;

// The contrast of each bit at a pixel, -1 to 1; 0 for bits that the code does not have.
[[nodiscard]] Bits contrastsOf(const AxisSignals& signals, std::size_t pixel);

// The number of the stripe that a Gray code of `count` bits names. `flipped` is a mask of bits to
// invert; its highest bit is the coarsest.
[[nodiscard]] int stripeOf(const Bits& bits, int count, unsigned flipped = 0);

// The code of a channel with so many pixels: a smaller picture has fewer bits than its round.
[[nodiscard]] AxisCode codeOf(const AxisSignals& signals, int pixels);

}  // namespace aquarama::scan
