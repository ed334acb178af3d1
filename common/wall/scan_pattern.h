// SPDX-License-Identifier: Apache-2.0
// Patterns of a scan as pure functions of a projector's pixel. Render nodes draw them, and tests
// compare the nodes' pictures with these functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/scan.h"

namespace aquarama::wall {

// The number of phase steps, and the period of the cosine. The finest stripe of the Gray code is
// half a period, so that both together name every column.
inline constexpr int kScanPhaseSteps = 4;
inline constexpr int kScanPeriodPixels = 32;

// The number of bits of a Gray code over `pixels` with stripes as fine as `finest`.
[[nodiscard]] constexpr int scanGrayBits(int pixels, int finest) {
    int bits = 0;
    while ((finest << bits) < pixels) ++bits;
    return bits;
}

// The exposure of a pattern's picture, as a share of that of the others.
[[nodiscard]] inline double scanExposure(const config::ScanPattern& pattern) {
    return pattern.kind == config::ScanPattern::Kind::Level ? std::pow(0.25, pattern.step) : 1;
}

// The tag: a row of square cells in the middle of the picture that says the number of the pattern:
// lit, dark, then the bits of the number, the highest first, then lit where the number of lit bits
// is odd.
inline constexpr int kScanTagBits = 12;
inline constexpr int kScanTagCells = kScanTagBits + 3;
// The cells' side is this share of the picture's width.
inline constexpr double kScanTagCellShare = 1.0 / 48;

// Side of a cell and the top left corner of the row, in pixels of a picture.
struct ScanTagPlace {
    int cell = 0;
    glm::ivec2 corner{};
};
[[nodiscard]] inline ScanTagPlace scanTagPlace(glm::ivec2 size) {
    const int cell = std::max(1, static_cast<int>(size.x * kScanTagCellShare));
    return {cell, (size - glm::ivec2(kScanTagCells * cell, cell)) / 2};
}
[[nodiscard]] inline bool scanTagIsLit(int cell, unsigned number) {
    if (cell < 2) return cell == 0;
    const int bit = kScanTagBits + 1 - cell;
    if (bit >= 0) return ((number >> static_cast<unsigned>(bit)) & 1U) != 0;
    bool odd = false;
    for (; number != 0; number &= number - 1) odd = !odd;
    return odd;
}

// Dots: Gaussian spots in the middles of kScanDots cells of a picture, numbered from 1, row by row,
// through all channels in their order. Their standard deviation is this share of the picture's
// width.
inline constexpr glm::ivec2 kScanDots{5, 4};
inline constexpr int kScanDotCount = kScanDots.x * kScanDots.y;
inline constexpr double kScanDotShare = 1.0 / 120;

// The place of a dot in a picture of this size, pixels.
[[nodiscard]] inline glm::dvec2 scanDotPlace(int dot, glm::ivec2 size) {
    return (glm::dvec2(dot % kScanDots.x, dot / kScanDots.x) + 0.5) * glm::dvec2(size) /
           glm::dvec2(kScanDots);
}
// The number of a dot among those of all channels.
[[nodiscard]] constexpr unsigned scanDotNumber(std::size_t channel, int dot) {
    return static_cast<unsigned>(channel) * kScanDotCount + static_cast<unsigned>(dot) + 1;
}
// Light at a pixel, 0 to 1, of dots whose number has the bit step - 1; of all for step 0.
[[nodiscard]] inline double scanDotShare(int step,
                                         std::size_t channel,
                                         glm::ivec2 size,
                                         glm::ivec2 pixel) {
    const glm::dvec2 at = glm::dvec2(pixel) + 0.5;
    const glm::ivec2 cell =
        glm::min(glm::ivec2(at * glm::dvec2(kScanDots) / glm::dvec2(size)), kScanDots - 1);
    const int dot = cell.y * kScanDots.x + cell.x;
    if (step > 0 && ((scanDotNumber(channel, dot) >> static_cast<unsigned>(step - 1)) & 1U) == 0)
        return 0;
    const glm::dvec2 off = (at - scanDotPlace(dot, size)) / (kScanDotShare * size.x);
    return std::exp(-0.5 * (off.x * off.x + off.y * off.y));
}

// How much of the pattern's light a place along its axis has, 0 to 1. `pixel`: a column or a row.
[[nodiscard]] inline double scanShare(const config::ScanPattern& pattern, int pixel, int pixels) {
    using Kind = config::ScanPattern::Kind;
    switch (pattern.kind) {
        case Kind::GrayColumns:
        case Kind::GrayRows: {
            const int bits = scanGrayBits(pixels, pattern.finestPixels);
            if (pattern.step >= bits) return 0;  // finer than the picture has
            const auto stripe = static_cast<unsigned>(pixel / pattern.finestPixels);
            const unsigned code = stripe ^ (stripe >> 1U);
            const bool lit = ((code >> static_cast<unsigned>(bits - 1 - pattern.step)) & 1U) != 0;
            return lit != pattern.inverse ? 1 : 0;
        }
        case Kind::PhaseColumns:
        case Kind::PhaseRows: {
            constexpr double kTurn = 6.283185307179586;
            const double phase = (pixel + 0.5) / kScanPeriodPixels -
                                 static_cast<double>(pattern.step) / kScanPhaseSteps;
            return 0.5 + 0.5 * std::cos(kTurn * phase);
        }
        case Kind::Level:
            return 1;
        case Kind::Room:
        case Kind::Dots:  // of no axis
            break;
    }
    return 0;
}

// Linear light at a pixel (column and row) of the picture of channel `channel`, of `size` pixels.
[[nodiscard]] inline glm::vec3 scanLight(const config::ScanPattern& pattern,
                                         std::size_t channel,
                                         glm::ivec2 size,
                                         glm::ivec2 pixel) {
    if (!config::contains(pattern.lit, channel)) return glm::vec3(0);
    if (pattern.tagged) {
        const auto [cell, corner] = scanTagPlace(size);
        const glm::ivec2 at = pixel - corner;
        if (at.x >= 0 && at.y >= 0 && at.y < cell && at.x < kScanTagCells * cell)
            return scanTagIsLit(at.x / cell, pattern.number) ? pattern.light : glm::vec3(0);
    }
    if (pattern.kind == config::ScanPattern::Kind::Dots)
        return pattern.light * static_cast<float>(scanDotShare(pattern.step, channel, size, pixel));
    return pattern.light * static_cast<float>(config::isOfRows(pattern.kind)
                                                  ? scanShare(pattern, pixel.y, size.y)
                                                  : scanShare(pattern, pixel.x, size.x));
}

}  // namespace aquarama::wall
