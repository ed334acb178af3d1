// SPDX-License-Identifier: Apache-2.0
// Compares the places of neighbouring pixels: fills in missing ones and drops wrong ones.
#pragma once

#include "calibration/scan/axis_reader.h"

namespace aquarama::scan {

// The distance, in pixels of the channel, between neighbouring pixels of the camera: the median
// across or down, whichever is larger; 0 where nothing is seen.
[[nodiscard]] float stepOf(const ChannelView& view, int width);

// Gives pixels without a place along `axis` another reading near the median of their neighbours.
// `owned`: the channel's pixels.
void settleDoubts(ChannelView& view,
                  int axis,
                  int width,
                  const std::vector<std::size_t>& owned,
                  const AxisReader& reader,
                  WorkerPool& pool);

// Drops pixels that agree with few of their neighbours, or disagree with several: errors, and edges
// of depth, where a pixel sees two places at once.
void dropOutliers(ChannelView& view, int width, WorkerPool& pool);
// Drop the pixels near the border of the channel's picture, and those within its tag. Call them
// last.
void dropBorders(ChannelView& view, float step, glm::ivec2 channelPixels);
void dropTag(ChannelView& view, float step, glm::ivec2 cameraPixels, glm::ivec2 channelPixels);

}  // namespace aquarama::scan
