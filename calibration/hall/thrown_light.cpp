// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/thrown_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

#include "common/wall/scan_pattern.h"

namespace aquarama::hall {

namespace {

// The dark end lifted, the bright end bent; both ends stay where they are.
double responseAt(const config::HallProjector& projector, int colour, double code) {
    const double pure =
        projector.gamma ? std::pow(code, (*projector.gamma)[colour]) : linearFromSrgb(code);
    const double lifted = (1 - projector.toe) * pure + projector.toe * code;
    if (projector.knee == 0) return lifted;
    const double start = 1 - projector.knee;
    const auto bent = [&](double light) {
        return light < start ? light
                             : start + projector.knee * std::tanh((light - start) / projector.knee);
    };
    return bent(lifted) / bent(1);
}

glm::vec3 codeOf(glm::vec3 light) {
    return {static_cast<float>(srgbFromLinear(std::clamp(double(light.x), 0.0, 1.0))),
            static_cast<float>(srgbFromLinear(std::clamp(double(light.y), 0.0, 1.0))),
            static_cast<float>(srgbFromLinear(std::clamp(double(light.z), 0.0, 1.0)))};
}

// The codes that a node sends.
glm::vec4 sent(const config::HallProjector& projector, glm::vec3 light) {
    constexpr float kMost = 255;
    return {lightOfCode(projector, glm::round(codeOf(light) * kMost) / kMost), 0};
}

// A picture without light, with the places of a channel's cable.
ThrownPicture emptyPicture(const TrueHall& hall, std::size_t channel, glm::ivec2 size) {
    ThrownPicture picture{.sizePixels = size, .light = {}};
    const auto& projector = hall.hall().projectors[hall.projectorOf(channel)];
    picture.black = {lightOfCode(projector, glm::vec3(0)), 0};
    const glm::dvec2 perPixel =
        glm::dvec2(size) / glm::dvec2(hall.rig().channels[channel].sizePixels);
    picture.offset = perPixel * hall.pictureFrom(channel, {0, 0});
    picture.scale = perPixel * hall.pictureFrom(channel, {1, 1}) - picture.offset;
    return picture;
}

std::size_t pixelsOf(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

// Fills in a pattern that changes along one axis only.
void fillLines(const config::HallProjector& projector,
               config::ScanPattern pattern,
               std::size_t channel,
               ThrownPicture& out) {
    const bool isRows = isOfRows(pattern.kind);
    pattern.tagged = false;
    const glm::ivec2 size = out.sizePixels, way = isRows ? glm::ivec2(0, 1) : glm::ivec2(1, 0);
    std::vector<glm::vec4> line;
    const int count = isRows ? size.y : size.x;
    line.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        line.push_back(sent(projector, wall::scanLight(pattern, channel, size, i * way)));
    const auto width = static_cast<std::size_t>(size.x);
    for (std::size_t i = 0; i < out.light.size(); ++i)
        out.light[i] = line[isRows ? i / width : i % width];
}

// Fills in a pattern of dots, most of whose pixels are dark.
void fillDots(const config::HallProjector& projector,
              const config::ScanPattern& pattern,
              std::size_t channel,
              ThrownPicture& out) {
    const glm::vec4 dark = sent(projector, glm::vec3(0));
    const auto width = static_cast<std::size_t>(out.sizePixels.x);
    for (std::size_t i = 0; i < out.light.size(); ++i) {
        const glm::vec3 light =
            wall::scanLight(pattern, channel, out.sizePixels, {i % width, i / width});
        constexpr float kDark = 1e-4F;  // has the code 0
        out.light[i] = light.r + light.g + light.b < kDark ? dark : sent(projector, light);
    }
}

void fillTag(const config::HallProjector& projector,
             const config::ScanPattern& pattern,
             std::size_t channel,
             ThrownPicture& out) {
    const auto [cell, corner] = wall::scanTagPlace(out.sizePixels);
    for (int i = 0; i < wall::kScanTagCells; ++i) {
        const glm::ivec2 start = corner + glm::ivec2(i * cell, 0);
        const glm::vec4 light =
            sent(projector, wall::scanLight(pattern, channel, out.sizePixels, start));
        for (int y = start.y; y < start.y + cell; ++y) {
            const auto first = static_cast<std::ptrdiff_t>(y) * out.sizePixels.x + start.x;
            std::fill_n(out.light.begin() + first, cell, light);
        }
    }
}

// The picture of a computer that draws at another size.
ThrownPicture resized(const ThrownPicture& full, glm::ivec2 size) {
    ThrownPicture small = full;
    small.sizePixels = size;
    small.light.resize(pixelsOf(size));
    const glm::dvec2 step = glm::dvec2(full.sizePixels) / glm::dvec2(size);
    small.scale = full.scale / step;
    small.offset = full.offset / step;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec2 place = step * (glm::dvec2(x, y) + 0.5);
            small.light[static_cast<std::size_t>(y * size.x + x)] =
                full.at(glm::vec2((place - full.offset) / full.scale));
        }
    return small;
}

ThrownPicture asSent(const TrueHall& hall, std::size_t channel, ThrownPicture picture) {
    const auto& mode = hall.hall().faults.mode;
    if (mode && mode->channel == channel) picture = resized(picture, mode->sizePixels);
    return picture;
}

}  // namespace

glm::vec4 ThrownPicture::at(glm::vec2 panelPixel) const {
    const glm::vec2 place = glm::vec2(scale) * panelPixel + glm::vec2(offset);
    const glm::vec2 size(sizePixels);
    if (glm::clamp(place, glm::vec2(0), size) != place) return black;
    const glm::vec2 spot = glm::clamp(place - 0.5F, glm::vec2(0), size - 1.0F);
    const glm::ivec2 low(spot);
    const glm::vec2 t = spot - glm::vec2(low);
    const int right = low.x + 1 < sizePixels.x ? 1 : 0;
    const int down = low.y + 1 < sizePixels.y ? sizePixels.x : 0;
    const glm::vec4* here = &light[static_cast<std::size_t>(low.y * sizePixels.x + low.x)];
    const glm::vec4 above = here[0] + t.x * (here[right] - here[0]);
    const glm::vec4 below = here[down] + t.x * (here[down + right] - here[down]);
    return above + t.y * (below - above);
}

glm::vec3 lightOfCode(const config::HallProjector& projector, glm::vec3 code) {
    glm::dvec3 own(0);
    for (int c = 0; c < 3; ++c) own[c] = responseAt(projector, c, double(code[c]));
    const glm::dvec3 even = projector.black + (1 - projector.black) * own;
    return glm::vec3(projector.primaries * even);
}

ThrownPicture thrown(const TrueHall& hall,
                     std::size_t channel,
                     const config::ScanPattern& pattern) {
    const config::HallProjector& projector = hall.hall().projectors[hall.projectorOf(channel)];
    ThrownPicture out = emptyPicture(hall, channel, hall.rig().channels[channel].sizePixels);
    out.light.resize(pixelsOf(out.sizePixels));
    if (pattern.kind == config::ScanPattern::Kind::Dots)
        fillDots(projector, pattern, channel, out);
    else
        fillLines(projector, pattern, channel, out);
    if (pattern.tagged && pattern.kind != config::ScanPattern::Kind::Room)
        fillTag(projector, pattern, channel, out);
    return asSent(hall, channel, std::move(out));
}

ThrownPicture thrown(const TrueHall& hall, std::size_t channel, const Light& picture) {
    assert(picture.sizePixels == hall.rig().channels[channel].sizePixels);
    const config::HallProjector& projector = hall.hall().projectors[hall.projectorOf(channel)];
    ThrownPicture out = emptyPicture(hall, channel, picture.sizePixels);
    out.light.reserve(picture.rgb.size());
    for (const glm::vec3& light : picture.rgb)
        out.light.emplace_back(lightOfCode(projector, codeOf(light)), 0);
    return asSent(hall, channel, std::move(out));
}

std::vector<ThrownPicture> allThrown(const TrueHall& hall, std::span<const Light> channels) {
    std::vector<ThrownPicture> pictures;
    for (std::size_t i = 0; i < hall.channels(); ++i)
        pictures.push_back(thrown(hall, i, channels[i]));
    return pictures;
}

ThrownPicture thrownWhite(const TrueHall& hall, std::size_t channel) {
    const config::HallProjector& projector = hall.hall().projectors[hall.projectorOf(channel)];
    ThrownPicture out = emptyPicture(hall, channel, {1, 1});
    out.light.emplace_back(lightOfCode(projector, glm::vec3(1)), 0);
    return out;
}

}  // namespace aquarama::hall
