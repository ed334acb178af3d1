// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/neighbours.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "calibration/scan/tag.h"
#include "common/base/statistics.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

bool isKnown(glm::vec2 place) {
    return place.x == place.x && place.y == place.y;
}

// Calls look(neighbour) for those within `reach` columns and rows.
template <class Look>
void forNeighbours(std::size_t pixel, int width, std::size_t pixels, int reach, const Look& look) {
    const auto column = static_cast<int>(pixel % static_cast<std::size_t>(width));
    const auto row = static_cast<int>(pixel / static_cast<std::size_t>(width));
    const auto rows = static_cast<int>(pixels / static_cast<std::size_t>(width));
    for (int y = std::max(0, row - reach); y <= std::min(rows - 1, row + reach); ++y)
        for (int x = std::max(0, column - reach); x <= std::min(width - 1, column + reach); ++x)
            if (x != column || y != row)
                look(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
}

// The median place of the neighbours; nothing where too few are known.
std::optional<float> expectedAt(const ChannelView& view, std::size_t pixel, int width, int axis) {
    constexpr int kReach = 2;
    constexpr std::size_t kLeast = 5;
    constexpr std::size_t kSide = 2 * kReach + 1;
    std::array<float, kSide * kSide> places{};
    std::size_t count = 0;
    forNeighbours(pixel, width, view.place.size(), kReach, [&](std::size_t other) {
        const float place = view.place[other][axis];
        if (place == place) places.at(count++) = place;
    });
    if (count < kLeast) return std::nullopt;
    return median(std::span(places).first(count));
}

void settleOnce(ChannelView& view,
                int axis,
                int width,
                const std::vector<std::size_t>& doubtful,
                const AxisReader& reader,
                WorkerPool& pool) {
    std::vector<Reading> readings(doubtful.size());
    forPixels(pool, doubtful.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (const auto expected = expectedAt(view, doubtful[i], width, axis))
                readings[i] = reader.readNear(doubtful[i], *expected);
    });
    for (std::size_t i = 0; i < doubtful.size(); ++i) {
        view.place[doubtful[i]][axis] = readings[i].place;
        view.sigma[doubtful[i]][axis] = readings[i].sigma;
    }
}

struct Votes {
    int agree = 0, differ = 0;
};
Votes votesOn(const ChannelView& view, std::size_t pixel, int width, float step) {
    constexpr float kSteps = 3, kDeviations = 5;  // lens and screen stretch the picture unevenly
    Votes votes;
    const glm::vec2 here = view.place[pixel];
    const float allowed =
        kSteps * step + kDeviations * std::max(view.sigma[pixel].x, view.sigma[pixel].y);
    forNeighbours(pixel, width, view.place.size(), 1, [&](std::size_t other) {
        if (!isKnown(view.place[other])) return;
        const glm::vec2 apart = glm::abs(view.place[other] - here);
        ++(std::max(apart.x, apart.y) < allowed ? votes.agree : votes.differ);
    });
    return votes;
}

bool isOutlier(const ChannelView& view, std::size_t pixel, int width, float step) {
    constexpr int kLeastAgree = 3, kMostDiffer = 1;
    if (!isKnown(view.place[pixel])) return true;
    const Votes votes = votesOn(view, pixel, width, step);
    return votes.agree < kLeastAgree || votes.differ > kMostDiffer;
}

// The median distance between pixels whose indices differ by `apart`.
float medianStep(const ChannelView& view, std::size_t apart) {
    constexpr std::size_t kStride = 3;
    std::vector<float> steps;
    for (std::size_t p = 0; p + apart < view.place.size(); p += kStride)
        if (isKnown(view.place[p]) && isKnown(view.place[p + apart]))
            steps.push_back(glm::length(view.place[p + apart] - view.place[p]));
    return steps.empty() ? 0 : median(steps);
}

void forget(ChannelView& view, std::size_t pixel) {
    view.place[pixel] = view.sigma[pixel] = glm::vec2(kUnknown);
}

}  // namespace

float stepOf(const ChannelView& view, int width) {
    return std::max(medianStep(view, 1), medianStep(view, static_cast<std::size_t>(width)));
}

void settleDoubts(ChannelView& view,
                  int axis,
                  int width,
                  const std::vector<std::size_t>& owned,
                  const AxisReader& reader,
                  WorkerPool& pool) {
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<std::size_t> doubtful;
        for (const std::size_t p : owned)
            if (!(view.place[p][axis] == view.place[p][axis])) doubtful.push_back(p);
        settleOnce(view, axis, width, doubtful, reader, pool);
    }
}

void dropOutliers(ChannelView& view, int width, WorkerPool& pool) {
    const float step = stepOf(view, width);
    std::vector<std::uint8_t> isDropped(view.place.size());
    forPixels(pool, view.place.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p)
            isDropped[p] = isOutlier(view, p, width, step) ? 1 : 0;
    });
    for (std::size_t p = 0; p < isDropped.size(); ++p)
        if (isDropped[p] != 0) forget(view, p);
}

void dropBorders(ChannelView& view, float step, glm::ivec2 channelPixels) {
    constexpr float kBorderSteps = 2;  // what a camera's lens mixes
    const glm::vec2 least(kBorderSteps * step);
    const glm::vec2 most = glm::vec2(channelPixels) - least;
    for (std::size_t p = 0; p < view.place.size(); ++p) {
        const glm::vec2 at = view.place[p];
        const bool inside =
            glm::all(glm::greaterThan(at, least)) && glm::all(glm::lessThan(at, most));
        if (!inside) forget(view, p);
    }
}

void dropTag(ChannelView& view, float step, glm::ivec2 cameraPixels, glm::ivec2 channelPixels) {
    constexpr double kMarginSteps = 2.5;
    const auto map = TagMap::of(view, cameraPixels, channelPixels);
    if (!map) return;
    const double margin = kMarginSteps * double{step} / map->cellPixels();
    const glm::dvec2 least(-margin), most(wall::kScanTagCells + margin, 1 + margin);
    for (int y = map->low().y; y <= map->high().y; ++y)
        for (int x = map->low().x; x <= map->high().x; ++x) {
            const glm::dvec2 cell = map->cellAt({x, y});
            if (glm::all(glm::greaterThan(cell, least)) && glm::all(glm::lessThan(cell, most)))
                forget(view, static_cast<std::size_t>(y * cameraPixels.x + x));
        }
}

}  // namespace aquarama::scan
