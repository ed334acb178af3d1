// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/small_channels.h"

#include <algorithm>

#include <glm/common.hpp>

#include "calibration/scan/tag.h"
#include "common/base/statistics.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

constexpr glm::ivec2 kGrid = SmallChannel::kGrid;

// Finds the cells of the channel's picture that the camera sees.
void markSeen(const ChannelView& view, glm::ivec2 channelPixels, SmallChannel& small) {
    small.seen.resize(static_cast<std::size_t>(kGrid.x * kGrid.y));
    const glm::vec2 scale = glm::vec2(kGrid) / glm::vec2(channelPixels);
    for (const glm::vec2 place : view.place) {
        if (!(place.x == place.x)) continue;
        const glm::ivec2 cell = glm::clamp(glm::ivec2(place * scale), glm::ivec2(0), kGrid - 1);
        small.seen[static_cast<std::size_t>(cell.y * kGrid.x + cell.x)] = 1;
    }
    const auto seen = std::ranges::count(small.seen, 1);
    small.seenShare = static_cast<float>(seen) / static_cast<float>(small.seen.size());
}

// The cell of a place, where it lies in the inner part: the edge has the light of others mixed in.
int cellIndex(glm::dvec2 cell) {
    constexpr double kInner = 0.3, kMargin = 1;
    const glm::dvec2 cells(wall::kScanTagCells, 1);
    if (glm::any(glm::greaterThan(glm::abs(cell - 0.5 * cells), 0.5 * cells + kMargin)))
        return SmallChannel::kBeside;
    const glm::dvec2 within = glm::floor(cell);
    const bool isInner = glm::all(glm::lessThan(glm::abs(cell - within - 0.5), glm::dvec2(kInner)));
    const bool isCell = within.y == 0 && within.x >= 0 && within.x < cells.x;
    return isInner && isCell ? static_cast<int>(within.x) : SmallChannel::kEdge;
}

// Finds where the small copies show the cells of a channel's tag.
void findCells(const Evidence& evidence, std::size_t c, SmallChannel& small) {
    const auto map = TagMap::of(
        evidence.view.channels[c], evidence.view.sizePixels, evidence.rig.channels[c].sizePixels);
    if (!map) return;
    const int factor = evidence.small.factor;
    const glm::ivec2 size = evidence.small.sizePixels;
    small.cells.assign(small.light.size(), SmallChannel::kBeside);
    const glm::ivec2 first = map->low() / factor, last = glm::min(map->high() / factor, size - 1);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const glm::dvec2 middle = glm::dvec2(x, y) * double(factor) + 0.5 * (factor - 1);
            small.cells[static_cast<std::size_t>(y * size.x + x)] = cellIndex(map->cellAt(middle));
        }
    small.hasTag = true;
    for (int cell = 0; cell < wall::kScanTagCells; ++cell)
        small.hasTag &= std::ranges::count(small.cells, cell) > 0;
}

SmallChannel smallOf(const Evidence& evidence, std::size_t c) {
    SmallChannel small;
    const ChannelView& view = evidence.view.channels[c];
    if (view.place.empty()) return small;
    markSeen(view, evidence.rig.channels[c].sizePixels, small);
    small.light = evidence.small.shrunk(view.light, evidence.view.sizePixels.x);
    Plane values = small.light;
    small.most = valueAtRank(values, values.size() * 49 / 50);
    if (evidence.channels[c].isTagged) findCells(evidence, c, small);
    return small;
}

}  // namespace

SmallChannels::SmallChannels(const Evidence& evidence)
    : black_{evidence.small.of(evidence.firstBlack)} {
    for (std::size_t c = 0; c < evidence.view.channels.size(); ++c)
        channels_.push_back(smallOf(evidence, c));
}

float SmallChannels::lightAt(std::size_t pixel, std::uint64_t lit) const {
    float light = 0;
    for (std::size_t c = 0; c < channels_.size(); ++c)
        if (config::contains(lit, c) && !channels_[c].light.empty())
            light += channels_[c].light[pixel];
    return light;
}

float SmallChannels::mostLight() const {
    float most = 0;
    for (const SmallChannel& channel : channels_) most = std::max(most, channel.most);
    return most;
}

}  // namespace aquarama::scan
