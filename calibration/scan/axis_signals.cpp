// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/axis_signals.h"

#include <algorithm>

#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

AxisSignals::AxisSignals(AxisCode axisCode, std::size_t pixels)
    : code{axisCode}, contrast(pixels * static_cast<std::size_t>(code.bits)) {
    if (!code.hasPhase) return;
    for (Plane* plane : {&cosine, &sine, &sum, &alternate}) plane->resize(pixels);
}

void AxisSignals::add(const ScanFrame& frame,
                      const Round& round,
                      const std::vector<ChannelView>& views,
                      WorkerPool& pool) {
    if (config::isGray(frame.pattern->kind))
        addStripes(frame, round, views, pool);
    else
        addPhase(frame, pool);
}

void AxisSignals::addStripes(const ScanFrame& frame,
                             const Round& round,
                             const std::vector<ChannelView>& views,
                             WorkerPool& pool) {
    const config::ScanPattern& pattern = *frame.pattern;
    const float unit =
        (pattern.inverse ? -1.0F : 1.0F) * (code.isPaired ? 0.5F : 1.0F) * kContrastUnit;
    const auto bits = static_cast<std::size_t>(code.bits);
    forPixels(pool, frame.luminance.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            const std::uint8_t owner = round.owner[p];
            if (owner == Round::kNobody || !config::contains(pattern.lit, owner)) continue;
            const float half = 0.5F * views[owner].light[p];
            std::int16_t& bit = contrast[p * bits + pattern.step];
            const float value =
                static_cast<float>(bit) + unit * (frame.luminance[p] - round.middle[p]) / half;
            bit = static_cast<std::int16_t>(std::clamp(value, -32767.0F, 32767.0F));
        }
    });
}

void AxisSignals::addPhase(const ScanFrame& frame, WorkerPool& pool) {
    const std::uint8_t step = frame.pattern->step;
    Plane& wave = step % 2 == 0 ? cosine : sine;
    const float sign = step < 2 ? 1.0F : -1.0F;
    const float alternating = step % 2 == 0 ? 1.0F : -1.0F;
    forPixels(pool, frame.luminance.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            const float light = frame.luminance[p];
            wave[p] += sign * light;
            sum[p] += light;
            alternate[p] += alternating * light;
        }
    });
}

Bits contrastsOf(const AxisSignals& signals, std::size_t pixel) {
    Bits bits{};
    const auto count = static_cast<std::size_t>(signals.code.bits);
    for (std::size_t k = 0; k < count; ++k)
        bits[k] =
            static_cast<float>(signals.contrast[pixel * count + k]) / AxisSignals::kContrastUnit;
    return bits;
}

int stripeOf(const Bits& bits, int count, unsigned flipped) {
    unsigned stripe = 0;
    for (int k = 0; k < count; ++k) {
        const bool lit = bits[static_cast<std::size_t>(k)] > 0;
        const unsigned turn = (flipped >> static_cast<unsigned>(count - 1 - k)) & 1U;
        stripe = (stripe << 1U) | ((static_cast<unsigned>(lit) ^ turn ^ stripe) & 1U);
    }
    return static_cast<int>(stripe);
}

AxisCode codeOf(const AxisSignals& signals, int pixels) {
    AxisCode code = signals.code;
    code.bits = std::min(code.bits, wall::scanGrayBits(pixels, code.finestPixels));
    return code;
}

}  // namespace aquarama::scan
