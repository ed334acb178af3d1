// SPDX-License-Identifier: Apache-2.0
#include "common/wall/adjusted_blend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::wall {

namespace {

double distanceToSide(glm::dvec2 place, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 side = to - from;
    const double square = glm::dot(side, side);
    const double t = square > 0 ? std::clamp(glm::dot(place - from, side) / square, 0.0, 1.0) : 0.0;
    return glm::distance(place, from + t * side);
}

// The distance of a place from a polygon; 0 inside, by the even-odd rule.
double distanceOutside(const std::vector<glm::dvec2>& corners, glm::dvec2 place) {
    bool isInside = false;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
        const glm::dvec2 a = corners[before], b = corners[i];
        distance = std::min(distance, distanceToSide(place, a, b));
        if ((a.y > place.y) != (b.y > place.y) &&
            place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
            isInside = !isInside;
    }
    return isInside ? 0 : distance;
}

// The position between two pictures, -1 to 1: linear across an overlap, 0 where both have one
// weight.
double side(double one, double other) {
    const double a = std::sqrt(one), b = std::sqrt(other);
    return (a - b) / (a + b);
}

// Hands out `all` in proportion to what each part wants, on top of what it was given, up to the
// most that each may have. Parts that are full drop out; the others share the rest, until nothing
// is left or all are full. Returns what is left.
double handOut(double all,
               std::vector<double> wanted,
               const std::vector<double>& most,
               std::vector<double>& given) {
    for (;;) {
        const double sum = std::accumulate(wanted.begin(), wanted.end(), 0.0);
        if (sum <= 0 || all <= 0) return all;
        const double rate = all / sum;
        bool anyIsFull = false;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (wanted[i] <= 0 || given[i] + rate * wanted[i] < most[i]) continue;
            all -= most[i] - given[i];
            given[i] = most[i];
            wanted[i] = 0;
            anyIsFull = true;
        }
        if (anyIsFull) continue;
        for (std::size_t i = 0; i < wanted.size(); ++i) given[i] += rate * wanted[i];
        return 0;
    }
}

}  // namespace

double AdjustedBlend::mask(std::size_t channel, glm::dvec2 pixel, glm::dvec2 panorama) const {
    double light = 1;
    for (const config::MaskedArea& mask : adjustments_.masks) {
        if (mask.channel.value_or(channel) != channel) continue;
        const bool isOfPicture = mask.pixelsOf == config::PixelsOf::Picture;
        const double outside = distanceOutside(mask.corners, isOfPicture ? pixel : panorama);
        if (outside >= mask.softPixels && outside > 0) continue;
        light *= mask.softPixels > 0 ? glm::smoothstep(0.0, mask.softPixels, outside) : 0;
    }
    return light;
}

std::optional<double> AdjustedBlend::widthOf(std::size_t one, std::size_t other) const {
    std::optional<double> width;
    for (const config::BlendLimit& limit : adjustments_.blends) {
        const bool isOfOne = limit.channel == one && limit.with.value_or(other) == other;
        const bool isOfOther = limit.channel == other && limit.with.value_or(one) == one;
        if (isOfOne || isOfOther)
            width = std::min(width.value_or(limit.widthPixels), limit.widthPixels);
    }
    return width;
}

// The factor for the share of the first of two channels that blend. The slope of side() gives the
// width of their overlap; where it is wider than the limit, the slope is raised to that of the
// limit.
double AdjustedBlend::narrowed(std::size_t one,
                               std::size_t other,
                               glm::dvec2 panorama,
                               const Pulls& pulls) const {
    const auto width = widthOf(one, other);
    if (!width) return 1;
    const auto sideAt = [&](glm::dvec2 place) -> std::optional<double> {
        const double a = pulls(one, place).value_or(0), b = pulls(other, place).value_or(0);
        return a + b > 0 ? std::optional(side(a, b)) : std::nullopt;
    };
    const double here = sideAt(panorama).value_or(1);
    glm::dvec2 slope(0);
    for (const int axis : {0, 1}) {
        constexpr double kStepPixels = 2;
        glm::dvec2 step(0);
        step[axis] = kStepPixels;
        const auto before = sideAt(panorama - step), after = sideAt(panorama + step);
        if (before || after)
            slope[axis] = (after.value_or(here) - before.value_or(here)) /
                          (kStepPixels * (int{before.has_value()} + int{after.has_value()}));
    }
    const double steeper = 2 / std::max(glm::length(slope) * *width, 1e-9);
    if (steeper <= 1 || here <= -1) return 1;
    const double wanted = std::clamp((1 + steeper * here) / 2, 0.0, 1.0);
    const double factor = wanted / ((1 + here) / 2);
    return factor * factor;
}

void AdjustedBlend::adjust(std::vector<BlendPart>& parts,
                           glm::dvec2 panorama,
                           const Pulls& pulls) const {
    double all = 0;
    for (const BlendPart& part : parts) all += part.share;
    std::vector<double> limited, unlimited, most;
    for (const BlendPart& part : parts) {
        unlimited.push_back(part.share * part.mask);
        limited.push_back(unlimited.back());
        most.push_back(part.mask * all);
        for (const BlendPart& other : parts)
            if (other.channel != part.channel)
                limited.back() *= narrowed(part.channel, other.channel, panorama, pulls);
    }
    std::vector<double> given(parts.size());
    // The light that masks take from a channel goes to others, even beyond limits.
    const double left = handOut(all, limited, most, given);
    handOut(left, unlimited, most, given);
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].share = given[i];
}

}  // namespace aquarama::wall
