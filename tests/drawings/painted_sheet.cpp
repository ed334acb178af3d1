// SPDX-License-Identifier: Apache-2.0
#include "tests/drawings/painted_sheet.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <glm/common.hpp>

#include "common/base/files.h"
#include "common/base/hash.h"
#include "common/base/log.h"

namespace aquarama::test {

namespace {

float hashed(int x, int y, std::uint32_t seed) {
    const auto bits = hashOf(static_cast<std::uint32_t>(x) +
                             hashOf(static_cast<std::uint32_t>(y) + hashOf(seed)));
    return static_cast<float>(bits >> 8U) / 16777216.0F;
}

// Crayons, linear Rec. 709.
constexpr std::array<glm::vec3, 12> kCrayons{{{0.75F, 0.03F, 0.03F},
                                              {0.90F, 0.22F, 0.02F},
                                              {0.95F, 0.70F, 0.03F},
                                              {0.10F, 0.45F, 0.06F},
                                              {0.02F, 0.20F, 0.07F},
                                              {0.03F, 0.12F, 0.55F},
                                              {0.15F, 0.50F, 0.85F},
                                              {0.25F, 0.05F, 0.45F},
                                              {0.90F, 0.25F, 0.42F},
                                              {0.25F, 0.10F, 0.04F},
                                              {0.03F, 0.03F, 0.03F},
                                              {0.03F, 0.55F, 0.50F}}};

// Which region of the drawing a texel is in: bars, stripes or patches, as the seed says.
std::uint32_t regionAt(glm::dvec2 texel, std::uint32_t seed) {
    const glm::dvec2 bent = texel + 40.0 * glm::dvec2{smoothNoise(texel / 90.0, seed + 1),
                                                      smoothNoise(texel / 90.0, seed + 2)};
    const std::uint32_t kind = hashOf(seed) % 3;
    if (kind == 0) return static_cast<std::uint32_t>(bent.x / 130);
    if (kind == 1) return static_cast<std::uint32_t>(bent.y / 70);
    return static_cast<std::uint32_t>(4 * smoothNoise(texel / 120.0, seed + 3));
}

// How thick the wax lies: strokes of 2 mm side by side in a direction of the region, and the grain
// of the paper.
float waxAt(glm::dvec2 sheet, std::uint32_t region, std::uint32_t seed) {
    const double turn = hashed(static_cast<int>(region), 0, seed + 5) * 3.1416F;
    const double across = sheet.x * std::sin(turn) - sheet.y * std::cos(turn) +
                          1.5 * static_cast<double>(smoothNoise(sheet / 9.0, seed + 6));
    const float stroke = 0.5F + 0.5F * static_cast<float>(std::sin(across * 6.2832 / 2));
    const float grain = smoothNoise(sheet / 0.5, seed + 7);
    return glm::clamp(0.55F + 0.35F * stroke + 0.25F * (grain - 0.5F), 0.0F, 1.0F);
}

// Whether a hand that wanders up to 2.5 mm takes the place for the fish.
bool isColoured(const drawings::Sheet& sheet, glm::dvec2 at, std::uint32_t seed) {
    constexpr double kNear = 20;  // texels
    const glm::dvec2 texel = sheet.place.texelAt(at);
    if (texel != glm::clamp(texel, glm::dvec2(-kNear), glm::dvec2(body::kSideTexels) + kNear))
        return false;
    const glm::dvec2 wander{smoothNoise(at / 12.0, seed + 8), smoothNoise(at / 12.0, seed + 9)};
    const glm::ivec2 pixel(static_cast<double>(drawings::kPixelsPerTexel) *
                           sheet.place.texelAt(at + 5.0 * (wander - 0.5)));
    return sheet.likeness.shape.at(pixel.x, pixel.y);
}

}  // namespace

float smoothNoise(glm::dvec2 at, std::uint32_t seed) {
    const glm::ivec2 cell(glm::floor(at));
    const glm::vec2 t = glm::smoothstep(glm::vec2(0), glm::vec2(1), glm::vec2(at - glm::floor(at)));
    return glm::mix(
        glm::mix(hashed(cell.x, cell.y, seed), hashed(cell.x + 1, cell.y, seed), t.x),
        glm::mix(hashed(cell.x, cell.y + 1, seed), hashed(cell.x + 1, cell.y + 1, seed), t.x),
        t.y);
}

glm::vec3 PaintedSheet::at(glm::dvec2 sheet) const {
    return bilinear(
        paper,
        glm::dvec2(paper.sizePixels) / 2.0 + pixelsPerMillimetre * glm::dvec2{sheet.x, -sheet.y});
}

bool PaintedSheet::isPaper(glm::dvec2 sheet) const {
    const glm::dvec2 half = glm::dvec2(paper.sizePixels) / (2 * pixelsPerMillimetre);
    return std::abs(sheet.x) < half.x && std::abs(sheet.y) < half.y;
}

PaintedSheet printed(const drawings::Sheet& sheet, glm::dvec2 paperMillimetres) {
    constexpr int kDotsPerInch = 120;
    const TemporaryFolder folder("sheet");
    const std::string base = (folder.path() / "sheet").string();
    writeWhole(base + ".pdf", drawings::pdfOf(sheet, paperMillimetres, "A line of text."));
    const std::string command = "pdftoppm -r " + std::to_string(kDotsPerInch) +
                                " -singlefile -png " + base + ".pdf " + base;
    if (std::system(command.c_str()) != 0)
        throw Error("no pdftoppm: install what packaging/packages/test.txt names");
    return {lightOf(readPng(base + ".png")), kDotsPerInch / 25.4};
}

PaintedSheet painted(const drawings::Sheet& sheet, PaintedSheet paper, std::uint32_t seed) {
    const std::uint32_t count = 3 + hashOf(seed + 10) % 3;
    for (int y = 0; y < paper.paper.sizePixels.y; ++y)
        for (int x = 0; x < paper.paper.sizePixels.x; ++x) {
            const glm::dvec2 off =
                glm::dvec2{x, y} + 0.5 - glm::dvec2(paper.paper.sizePixels) / 2.0;
            const glm::dvec2 at = glm::dvec2{off.x, -off.y} / paper.pixelsPerMillimetre;
            if (!isColoured(sheet, at, seed)) continue;
            const std::uint32_t region = regionAt(sheet.place.texelAt(at), seed);
            // Some regions stay white.
            const std::uint32_t pick = hashOf(region % count + hashOf(seed + 11));
            if (pick % 7 == 0) continue;
            const glm::vec3 crayon = kCrayons.at(pick % kCrayons.size());
            paper.paper.at(x, y) *= glm::mix(glm::vec3(1), crayon, waxAt(at, region, seed));
        }
    return paper;
}

}  // namespace aquarama::test
